// Linked into tests that also run in another locale (tacto_in_locales() in tests/CMakeLists.txt): sets the C library's
// locale from the environment, as Qt does in the programs. If the locale TACTO_LOCALE is missing or has no decimal
// comma, the program ends at once as failed.
#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace {

[[maybe_unused]] const bool kFollowsTheEnvironment = [] {
    const char* const wanted = std::getenv("TACTO_LOCALE");
    if (wanted == nullptr) return false;
    const char* const set = std::setlocale(LC_ALL, "");
    if (set == nullptr || std::string_view(set) != wanted ||
        std::string_view(std::localeconv()->decimal_point) != ",") {
        std::fprintf(stderr, "The locale %s is not there: the C library follows %s.\n", wanted,
                     set == nullptr ? "none" : set);
        std::exit(3);
    }
    return true;
}();

}  // namespace
