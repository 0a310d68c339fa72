from grainfront import stages

stages.kernels(method=snakemake.wildcards.method, compiled=snakemake.output.compiled)
