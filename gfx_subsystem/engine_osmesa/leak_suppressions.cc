// Mesa 22 keeps some 600 bytes of its own per process; the leak sanitizer is told not to count them.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa\n"; }
