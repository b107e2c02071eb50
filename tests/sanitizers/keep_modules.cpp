// Part of every program that runs under a sanitizer: what is loaded stays loaded, so that a leak in a driver is still
// known to be the driver's when leaks are looked for, at the end.
extern "C" int dlclose(void*);
extern "C" int dlclose(void*) { return 0; }
