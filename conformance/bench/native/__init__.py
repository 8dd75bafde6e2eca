"""A yardstick in C++: the two hot kernels, written from the specification by themselves.

`yardstick.cpp` is source, compiled with the system's compiler when it is asked for.
"""
