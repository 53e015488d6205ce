// Any bytes as a sigrok session (.sr) are read or refused with a sentence, with memory limited by the input's size
// (hazard H10). Deflate can turn one byte into 1032.
#include "drivers/sigrok/session_file/SigrokFormat.h"
#include "tests/fuzz/CaptureCheck.h"
#include "tests/fuzz/FuzzTarget.h"
#include "tests/fuzz/InputFile.h"

namespace tacto::fuzz::SigrokSessionFuzz {

TACTO_FUZZ(SigrokSessionFuzz, const std::uint8_t* data, std::size_t size) {
    const auto path = tacto::fuzz::inputFile("input.sr", {data, size});
    tacto::fuzz::checkCapture(tacto::SigrokFormat().read(path, {}, {}), 1032 * size);
    return 0;
}

}  // namespace tacto::fuzz::SigrokSessionFuzz
