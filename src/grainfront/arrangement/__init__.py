"""Spatial arrangement: zones of the plane, the regions they make, and the laws that hold there."""
