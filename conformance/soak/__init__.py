"""Long campaigns of random queries: numbered, in shards that any process can ask, kept in a journal."""
