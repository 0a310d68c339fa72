"""Result datasets, VTK files and how they reach the disk."""
