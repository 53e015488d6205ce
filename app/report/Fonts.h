// Fonts.h - the faces a report is set in, the window's own (Noto Sans, and for each sign that it lacks Noto Sans Math,
// then DejaVu Sans), and the check that the last of them is there: without a font Qt writes pages that have lost their
// text and says nothing. Debian has the first two in fonts-noto-core.
//
// Sizes are in the report's unit, 1/96 inch.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QFont>
#include <functional>

#include "core/base/Result.h"

namespace tacto {

/// True when a font family is installed.
using FontCheck = std::function<bool(const QString& family)>;
[[nodiscard]] bool fontInstalled(const QString& family);

/// Errors: Unsupported naming the missing family and the package that has it.
[[nodiscard]] Result<void> requireFonts(const FontCheck& installed = fontInstalled);

[[nodiscard]] QFont textFont(double size, bool bold = false);
[[nodiscard]] QFont monoFont(double size);

}  // namespace tacto
