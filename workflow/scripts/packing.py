from grainfront import stages

stages.packing(
    scene=snakemake.params.scene,
    database=snakemake.input.database,
    seed=int(snakemake.wildcards.seed),
    packing=snakemake.output.packing,
    timing=snakemake.output.timing,
)
