// libsigrok 0.5.2 leaks memory: 2 kB for each question about the trigger (rigol-ds), some hundred bytes for each .sr
// file that is opened or written. Only leaks that libsigrok allocated itself are ignored; for that the leak checker
// needs whole stacks, because libsigrok and GLib are built without frame pointers.
#ifdef TACTOSCOPE_SANITIZED
extern "C" {
const char* __asan_default_options();
const char* __asan_default_options() { return "fast_unwind_on_malloc=0"; }
const char* __lsan_default_suppressions();
const char* __lsan_default_suppressions() { return "leak:libsigrok.so.4\nleak:libsigrokcxx.so.4\n"; }
}
#endif
