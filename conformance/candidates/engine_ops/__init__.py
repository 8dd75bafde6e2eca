"""The operations of ``vectors/FORMAT.md``, performed by the engine; one module per family."""
