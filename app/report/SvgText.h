// SvgText.h - texts of a drawn SVG, each in one piece: Qt writes a text again wherever another face helps out, at a
// place that holds for the reader's faces only if they are ours, and a number must not come apart from its minus.
//
// Thread-safety: the GUI thread (it measures type).
#pragma once

#include <QString>

namespace tacto {

/// `svg`, as QSvgGenerator writes it, with each text joined to the one before that ends where it begins; the faces are
/// named with those that stand in for them elsewhere.
[[nodiscard]] QString withWholeTexts(const QString& svg);

}  // namespace tacto
