from grainfront import stages

stages.sweep(
    scene=snakemake.params.scene,
    database=snakemake.input.database,
    chunk=int(snakemake.wildcards.chunk),
    chunks=int(snakemake.wildcards.chunks),
    folder=snakemake.params.folder,
    threads=snakemake.threads,
)
