from grainfront import stages

stages.contour(
    scene=snakemake.params.scene,
    database=snakemake.input.database,
    folder=snakemake.params.folder,
    threads=snakemake.threads,
    contour=snakemake.output.contour,
    timing=snakemake.output.timing,
)
