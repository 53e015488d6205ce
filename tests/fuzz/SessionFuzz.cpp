// Any file at all is judged and read without a crash, a hang or a leak (hazard H10). Seed it with real sessions:
//   fuzz_SessionFuzz corpus/ where corpus/ holds *.tacto files
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <unistd.h>

#include "core/session/SessionReader.h"
#include "core/session/SessionVerify.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto path =
        std::filesystem::temp_directory_path() / ("tactoscope-fuzz-" + std::to_string(getpid()) + ".tacto");
    std::ofstream(path, std::ios::binary | std::ios::trunc)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    static_cast<void>(tacto::verifySession(path));
    if (const auto reader = tacto::SessionReader::open(path)) {
        static_cast<void>(reader->reproducibleText());
        static_cast<void>(reader->trials());
        static_cast<void>(reader->verdicts());
        if (const auto captures = reader->captures()) {
            for (const auto& info : *captures) static_cast<void>(reader->capture(info.seq));
        }
        if (const auto streams = reader->streams()) {
            for (const auto& info : *streams) static_cast<void>(reader->samples(info.id));
        }
    }
    std::filesystem::remove(path);
    return 0;
}
