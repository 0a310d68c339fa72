from grainfront import stages

stages.stability_report(
    record=snakemake.input.record,
    table=snakemake.output.table,
    matrix_picture=snakemake.output.matrix_picture,
    clearance_picture=snakemake.output.clearance_picture,
)
