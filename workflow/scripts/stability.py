from grainfront import stages

stages.stability(record=snakemake.output.record)
