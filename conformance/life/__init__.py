"""Life with cases: choosing them, beginning new ones, and seeing what retail does in one."""
