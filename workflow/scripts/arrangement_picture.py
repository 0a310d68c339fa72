from grainfront import stages

stages.arrangement_picture(scene=snakemake.params.scene, picture=snakemake.output.picture)
