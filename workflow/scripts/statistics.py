from grainfront import stages

stages.statistics(
    scene=snakemake.params.scene,
    database=snakemake.input.database,
    seeds=snakemake.params.seeds,
    packings=snakemake.input.packings,
    statistics=snakemake.output.statistics,
)
