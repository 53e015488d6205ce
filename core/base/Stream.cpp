#include "core/base/Stream.h"

namespace tacto {

std::string_view nameOf(StreamKind kind) noexcept {
    switch (kind) {
        case StreamKind::Acceleration:
            return "acceleration";
        case StreamKind::Force:
            return "force";
        case StreamKind::Taxels:
            return "taxels";
    }
    return "stream";
}

std::string_view symbolOf(StreamUnit unit) noexcept {
    switch (unit) {
        case StreamUnit::MetrePerSecondSquared:
            return "m/s2";
        case StreamUnit::Newton:
            return "N";
        case StreamUnit::Pascal:
            return "Pa";
        case StreamUnit::Count:
            return "count";
    }
    return "";
}

}  // namespace tacto
