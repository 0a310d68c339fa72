from grainfront import stages

stages.vtk(packing=snakemake.input.packing, vtp=snakemake.output.vtp)
