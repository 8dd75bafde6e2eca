"""Protocol v1: how an engine in any language is asked, one JSON object a line on its stdin and stdout."""
