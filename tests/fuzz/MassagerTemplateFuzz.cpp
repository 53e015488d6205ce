// Any text as a massager's template is refused with a sentence, or gives reports that can be sent (hazard H10).
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "drivers/hid_massager/MassagerTemplate.h"
#include "tests/fuzz/FuzzTarget.h"

namespace tacto::fuzz::MassagerTemplateFuzz {

TACTO_FUZZ(MassagerTemplateFuzz, const std::uint8_t* data, std::size_t size) {
    using namespace tacto::hid;
    const auto read = parseMassagerTemplate({reinterpret_cast<const char*>(data), size}, "fuzz.json");
    if (!read) {
        if (read.error().code != tacto::ErrorCode::ParseError || !read.error().message.starts_with("fuzz.json: ")) {
            std::abort();
        }
        return 0;
    }
    if (read->title.empty() || read->source.empty() || read->devices.empty() || read->lengths.empty()) std::abort();
    for (const auto length : read->lengths) {
        const auto reports = read->reports(length);
        if (!reports || !validate(*reports) || reports->start.size() != length) std::abort();
        for (const double intensity : {0.0, 0.3, 1.0}) {
            const auto bytes = startBytes(*reports, intensity);
            if (!bytes || bytes->size() != length) std::abort();
            for (const auto& field : reports->fields) {
                const auto value = valueOf(field, *bytes);
                if (value < field.min || value > field.max) std::abort();
            }
        }
    }
    return 0;
}

}  // namespace tacto::fuzz::MassagerTemplateFuzz
