// Any JSON as a figure of a report is read, or refused with a sentence (hazard H10).
#include <QJsonDocument>
#include <QJsonObject>
#include <cstdint>
#include <cstdlib>

#include "app/report/Figure.h"
#include "tests/fuzz/FuzzTarget.h"

namespace tacto::fuzz::FigureFuzz {

TACTO_FUZZ(FigureFuzz, const std::uint8_t* data, std::size_t size) {
    const auto text = QByteArray::fromRawData(reinterpret_cast<const char*>(data), static_cast<qsizetype>(size));
    const auto document = QJsonDocument::fromJson(text);
    if (!document.isObject()) return 0;
    auto figure = tacto::parseFigure(document.object());
    if (!figure) {
        if (figure.error().message.empty()) std::abort();
        return 0;
    }
    const auto none = [](qint64) -> tacto::Result<tacto::Capture> {
        return tacto::fail(tacto::ErrorCode::NotFound, "no capture");
    };
    static_cast<void>(tacto::resolveCaptures(*figure, none));
    return 0;
}

}  // namespace tacto::fuzz::FigureFuzz
