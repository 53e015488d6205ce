// tactoscope-declare NAME PATH LIMIT_MS: reads a protocol script from standard input and writes what it declares to
// standard output, as JSON. A process of its own, since a script can make the engine crash.
#include <QCoreApplication>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <sys/prctl.h>
#include <sys/resource.h>

#include "app/scripting/engine/DeclarationReader.h"
#include "core/base/JsonText.h"
#include "core/base/Text.h"

int main(int argc, char** argv) {
    using namespace tacto;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const rlimit none{0, 0};
    setrlimit(RLIMIT_CORE, &none);
    if (argc != 4) {
        std::fputs("usage: tactoscope-declare NAME PATH LIMIT_MS < SCRIPT\n", stderr);
        return 2;
    }
    const auto limit = parseNumber(argv[3]);
    if (!limit || !(*limit >= 1 && *limit <= 60'000)) {
        std::fputs("tactoscope-declare: LIMIT_MS is from 1 to 60000\n", stderr);
        return 2;
    }
    const QCoreApplication application(argc, argv);
    ProtocolSource source;
    source.name = argv[1];
    source.path = argv[2];
    char block[65536];
    for (std::size_t got = 0; (got = std::fread(block, 1, sizeof block, stdin)) > 0;) source.text.append(block, got);
    const auto declared = declareHere(source, std::chrono::milliseconds(static_cast<std::int64_t>(*limit)));
    const auto answer = dumpJson(answerOf(declared), -1, true);
    const bool written = std::fwrite(answer.data(), 1, answer.size(), stdout) == answer.size();
    const bool flushed = std::fflush(stdout) == 0;
    // A script that did not end when asked to may still run: nothing is torn down under it.
    std::_Exit(written && flushed ? 0 : 3);
}
