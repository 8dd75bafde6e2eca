"""The model of a YAML case: what keys there are, what they take, and how a mistake is told."""
