from grainfront import stages

stages.kernels(method=snakemake.wildcards.method)
