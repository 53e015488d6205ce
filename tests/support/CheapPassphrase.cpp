// Linked or preloaded into a program, this file derives a passphrase's key at the lowest cost that libsodium accepts.
// At the program's own cost (0.5 s and 256 MB), keys take two thirds of the time of the study tests. One test keeps
// this cost (tests/cli/StudyCommandTest.cpp); tests/study/SealedTextTest.cpp checks that it is the default.
#include <dlfcn.h>
#include <sodium.h>

extern "C" int crypto_pwhash(unsigned char* const out, unsigned long long outlen, const char* const passwd,
                             unsigned long long passwdlen, const unsigned char* const salt, unsigned long long,
                             std::size_t, int alg) {
    using Derive = decltype(&crypto_pwhash);
    static const auto derive = reinterpret_cast<Derive>(dlsym(RTLD_NEXT, "crypto_pwhash"));
    return derive(out, outlen, passwd, passwdlen, salt, crypto_pwhash_OPSLIMIT_MIN, crypto_pwhash_MEMLIMIT_MIN, alg);
}
