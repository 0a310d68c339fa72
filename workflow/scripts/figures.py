from grainfront import stages

stages.figures(
    length_unit=snakemake.params.length_unit,
    hulls=snakemake.input.hulls,
    outlines=snakemake.input.get("outlines"),
    contacts=snakemake.input.contacts,
    statistics=snakemake.input.statistics,
    packing_picture=snakemake.output.packing,
    laws_picture=snakemake.output.laws,
    contacts_picture=snakemake.output.contacts,
    rose_picture=snakemake.output.rose,
)
