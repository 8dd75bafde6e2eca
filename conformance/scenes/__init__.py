"""Scenes: the neutral model, primitives to write it with, the BSP builder and importers."""
