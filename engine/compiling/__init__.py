"""From plain data to the flat arrays that kernels read (`engine.layout`); one module per kind of record."""
