from grainfront import stages

stages.contour_picture(
    scene=snakemake.params.scene,
    contour=snakemake.input.contour,
    picture=snakemake.output.picture,
)
