from grainfront import stages

stages.shapes(scene=snakemake.params.scene, database=snakemake.output.database)
