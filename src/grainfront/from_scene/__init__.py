"""From a scene to its packing and its statistics: what ties laws, regions and kernels together."""
