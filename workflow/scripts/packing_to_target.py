from grainfront import stages

stages.packing_to_target(
    scene=snakemake.params.scene,
    database=snakemake.input.database,
    seed=int(snakemake.wildcards.seed),
    contour=snakemake.input.get("contour"),
    packing=snakemake.output.packing,
    target=snakemake.output.target,
    timing=snakemake.output.timing,
)
