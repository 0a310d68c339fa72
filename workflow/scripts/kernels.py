from grainfront import stages

stages.kernels(search=snakemake.wildcards.search)
