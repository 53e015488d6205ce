// Linked or preloaded into a program: it makes the key of a passphrase at the least cost that libsodium accepts. At the
// program's own, half a second and 256 MB, that is two thirds of what the tests of studies take. One test keeps the
// full cost (tests/cli/StudyCommandTest.cpp); that it is the default is asked in tests/study/SealedTextTest.cpp.
#include <dlfcn.h>
#include <sodium.h>

extern "C" int crypto_pwhash(unsigned char* const out, unsigned long long outlen, const char* const passwd,
                             unsigned long long passwdlen, const unsigned char* const salt, unsigned long long,
                             std::size_t, int alg) {
    using Derive = decltype(&crypto_pwhash);
    static const auto derive = reinterpret_cast<Derive>(dlsym(RTLD_NEXT, "crypto_pwhash"));
    return derive(out, outlen, passwd, passwdlen, salt, crypto_pwhash_OPSLIMIT_MIN, crypto_pwhash_MEMLIMIT_MIN, alg);
}
