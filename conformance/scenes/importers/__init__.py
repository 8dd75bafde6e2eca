"""Importers: scenes from files of other projects."""
