"""What takes many packings of a scene; files are written elsewhere."""
