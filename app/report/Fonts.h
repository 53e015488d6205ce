// Fonts.h - the fonts of a report, the same as in the window: Noto Sans, and for missing characters Noto Sans Math,
// then DejaVu Sans. Checks that DejaVu Sans is installed: without a font Qt writes pages without text and gives no
// error. Debian has the first two in fonts-noto-core.
//
// Sizes are in the report's unit, 1/96 inch.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QFont>
#include <functional>

#include "core/base/Result.h"

namespace tacto {

/// True if a font family is installed.
using FontCheck = std::function<bool(const QString& family)>;
[[nodiscard]] bool fontInstalled(const QString& family);

/// Errors: Unsupported naming the missing family and its package.
[[nodiscard]] Result<void> requireFonts(const FontCheck& installed = fontInstalled);

[[nodiscard]] QFont textFont(double size, bool bold = false);
[[nodiscard]] QFont monoFont(double size);

}  // namespace tacto
