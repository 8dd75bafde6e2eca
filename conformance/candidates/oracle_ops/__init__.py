"""The operations of ``vectors/FORMAT.md``, performed by the oracle; one module per family."""
