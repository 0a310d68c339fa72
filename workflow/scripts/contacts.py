from grainfront import stages

stages.contacts(
    scene=snakemake.params.scene,
    seed=int(snakemake.wildcards.seed),
    packing=snakemake.input.packing,
    contacts=snakemake.output.contacts,
)
