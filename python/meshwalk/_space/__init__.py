"""Surfaces in space: what changes them, and what rays, probes and points meet of them."""
