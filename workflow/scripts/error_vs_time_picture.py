from grainfront import stages

stages.error_vs_time_picture(
    record=snakemake.input.record,
    axis=snakemake.wildcards.axis,
    picture=snakemake.output.picture,
)
