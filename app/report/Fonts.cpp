#include "app/report/Fonts.h"

#include <QFontDatabase>
#include <QStringList>

namespace tacto {
namespace {

constexpr auto kFallback = "DejaVu Sans";
constexpr auto kMono = "DejaVu Sans Mono";

QFont fontOf(const QStringList& families, double size) {
    QFont font(families);
    font.setPixelSize(qMax(1, qRound(size)));
    // Hinted widths are rounded to the pixels of a screen, and a page has none.
    font.setHintingPreference(QFont::PreferNoHinting);
    font.setStyleStrategy(QFont::ForceOutline);
    return font;
}

}  // namespace

bool fontInstalled(const QString& family) { return QFontDatabase::families().contains(family); }

Result<void> requireFonts(const FontCheck& installed) {
    for (const char* family : {kFallback, kMono}) {
        if (!installed(QString::fromLatin1(family))) {
            return fail(ErrorCode::Unsupported,
                        "The font \"{}\" is not installed, and without it a report would lose its text; install the "
                        "package fonts-dejavu-core.",
                        family);
        }
    }
    return {};
}

QFont textFont(double size, bool bold) {
    // Debian's Noto Sans lacks minus, ≤ and arrows; Noto Sans Math has them with the same widths.
    static const QStringList kFamilies{"Noto Sans", "Noto Sans Math", kFallback};
    QFont font = fontOf(kFamilies, size);
    font.setBold(bold);
    return font;
}

QFont monoFont(double size) { return fontOf({kMono}, size); }

}  // namespace tacto
