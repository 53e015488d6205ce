#include "app/report/Fonts.h"

#include <QFontDatabase>
#include <QStringList>

namespace tacto {
namespace {

constexpr auto kText = "DejaVu Sans";
constexpr auto kMono = "DejaVu Sans Mono";

QFont fontOf(const char* family, double size) {
    QFont font(QString::fromLatin1(family));
    font.setPixelSize(qMax(1, qRound(size)));
    // Hinted advances are rounded to pixels of a screen that a page does not have.
    font.setHintingPreference(QFont::PreferNoHinting);
    font.setStyleStrategy(QFont::ForceOutline);
    return font;
}

}  // namespace

bool fontInstalled(const QString& family) { return QFontDatabase::families().contains(family); }

Result<void> requireFonts(const FontCheck& installed) {
    for (const char* family : {kText, kMono}) {
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
    QFont font = fontOf(kText, size);
    font.setBold(bold);
    return font;
}

QFont monoFont(double size) { return fontOf(kMono, size); }

}  // namespace tacto
