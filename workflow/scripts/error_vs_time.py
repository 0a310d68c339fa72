from grainfront import stages

stages.error_vs_time(
    scene=snakemake.params.scene,
    database=snakemake.input.database,
    record=snakemake.output.record,
)
