// Any bytes as a capture of any format: read or refused with a sentence, with memory limited by the input's size. The
// first byte chooses the options; the rest is the file, kept in memory if the system allows.
#include <cstdint>
#include <string_view>
#include <sys/mman.h>
#include <unistd.h>

#include "core/formats/CaptureFormats.h"
#include "tests/fuzz/CaptureCheck.h"
#include "tests/fuzz/FuzzTarget.h"

namespace tacto::fuzz::CaptureFormatsFuzz {

namespace {

tacto::ReadOptions optionsFrom(std::uint8_t bits) {
    tacto::ReadOptions options;
    if ((bits & 1U) != 0) options.rate = tacto::Hertz(1e6);
    if ((bits & 2U) != 0) options.skipRows = 1;
    if ((bits & 4U) != 0) options.columns = {"2"};
    if ((bits & 8U) != 0) options.timeColumn = "1";
    if ((bits & 16U) != 0) options.units = {{"2", "mV"}};
    if ((bits & 32U) != 0) options.probeFactors = {{"2", -10.0}};
    return options;
}

}  // namespace

TACTO_FUZZ(CaptureFormatsFuzz, const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    static const auto formats = tacto::ownCaptureFormats();
    static const int file = memfd_create("capture", 0);
    static const std::string path = "/proc/self/fd/" + std::to_string(file);
    const auto options = optionsFrom(data[0]);
    if (file < 0 || ftruncate(file, 0) != 0) return 0;
    if (pwrite(file, data + 1, size - 1, 0) != static_cast<ssize_t>(size - 1)) return 0;
    tacto::fuzz::checkCapture(formats->read(path, options), size);
    return 0;
}

}  // namespace tacto::fuzz::CaptureFormatsFuzz
