"""Reproducible packings of irregular grains by the optimised advancing front method."""
