from grainfront import stages

stages.replacement(
    scene=snakemake.params.scene,
    database=snakemake.input.database,
    seed=int(snakemake.wildcards.seed),
    packing=snakemake.input.packing,
    nonconvex=snakemake.output.nonconvex,
)
