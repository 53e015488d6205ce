// HostileLsl.cpp - a library with liblsl's functions that does what a broken network or a broken liblsl may do; what it
// does is said by lslTestDoes().
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <string>
#include <thread>

namespace {

std::atomic<const char*> doing{"nothing"};
bool does(const char* what) { return std::strcmp(doing, what) == 0; }
void hangIf(const char* what) {
    while (does(what)) std::this_thread::sleep_for(std::chrono::milliseconds(5));
}
double now_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }
char kThing;
std::atomic<int> created{0}, looked{0}, given{0};

}  // namespace

extern "C" {
void lslTestDoes(const char* what) {  // a literal
    doing = what;
    looked = given = 0;
}
int lslTestCreated() { return created; }
int lslTestLooked() { return looked; }
int lslTestGiven() { return given; }

std::int32_t lsl_library_version() { return does("is old") ? 112 : 118; }
double lsl_local_clock() { return does("has no clock") ? NAN : now_s(); }
const char* lsl_last_error() { return "no network"; }
void* lsl_create_streaminfo(const char*, const char*, std::int32_t, double, std::int32_t, const char*) {
    return does("refuses") ? nullptr : &kThing;
}
void lsl_destroy_streaminfo(void*) {}
std::int32_t lsl_get_channel_count(void*) { return does("has two channels") ? 2 : 1; }
std::int32_t lsl_get_channel_format(void*) { return does("has numbers") ? 2 : 3; }
void* lsl_get_desc(void*) { return &kThing; }
void* lsl_append_child(void*, const char*) { return &kThing; }
void* lsl_append_child_value(void*, const char*, const char*) { return &kThing; }
void* lsl_create_outlet(void*, std::int32_t, std::int32_t) {
    hangIf("hangs at the start");
    if (does("refuses the outlet")) return nullptr;
    ++created;
    return &kThing;
}
void lsl_destroy_outlet(void*) { hangIf("hangs at the end"); }
std::int32_t lsl_have_consumers(void*) { return 1; }
std::int32_t lsl_push_sample_dtp(void*, const double*, double, std::int32_t) {
    hangIf("hangs while sending");
    return does("loses samples") ? -4 : 0;
}
std::int32_t lsl_push_sample_buftp(void*, const char**, const std::uint32_t*, double, std::int32_t) {
    return lsl_push_sample_dtp(nullptr, nullptr, 0, 0);
}
std::int32_t lsl_resolve_byprop(void** found, std::uint32_t, const char*, const char*, std::int32_t, double) {
    ++looked;
    hangIf("hangs while looking");
    if (does("finds nothing")) return 0;
    found[0] = &kThing;
    return 1;
}
void* lsl_create_inlet(void*, std::int32_t, std::int32_t, std::int32_t) { return &kThing; }
void lsl_destroy_inlet(void*) {}
void lsl_open_stream(void*, double, std::int32_t* error) { *error = does("never opens") ? -1 : 0; }
double lsl_time_correction(void*, double, std::int32_t* error) {
    *error = does("has no correction") ? -1 : 0;
    return 0;
}
double lsl_pull_sample_buf(void*, char** text, std::uint32_t* length, std::int32_t, double, std::int32_t* error) {
    *error = 0;
    hangIf("hangs while taking");
    std::string sent;
    if (does("floods"))
        sent = "flood";
    else if (does("sends a mebibyte"))
        sent.assign(1 << 20, '\xe4');
    else if (does("sends bytes"))
        sent = std::string("a\0b\x1b[2J\xff\xc3\xb6", 11);
    else if (does("loses its stream"))
        *error = -2;
    if (sent.empty() || (!does("floods") && ++given > 3)) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        return 0;
    }
    *text = static_cast<char*>(std::malloc(sent.size()));
    std::memcpy(*text, sent.data(), sent.size());
    *length = static_cast<std::uint32_t>(sent.size());
    return does("sends bytes") ? INFINITY : now_s();
}
void lsl_destroy_string(char* text) { std::free(text); }
}
