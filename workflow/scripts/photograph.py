from grainfront import stages

stages.photograph(scene=snakemake.params.scene, picture=snakemake.output.picture)
