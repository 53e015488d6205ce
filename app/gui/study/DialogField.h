// DialogField.h - fields of a study's dialogs, as a form of parameters takes them.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QString>
#include <span>
#include <string>

#include "app/scripting/engine/ProtocolParameter.h"
#include "core/study/Study.h"

namespace tacto::gui {

[[nodiscard]] ProtocolParameter dialogField(const char* name, const QString& label, ParameterType type,
                                            std::string value);
/// "3  severe": a score with its word of NextDay.h.
[[nodiscard]] QString scoreChoice(std::span<const char* const> words, int score, int from = 1);
/// A score that has to be chosen: `words` say what its numbers mean. Without it `needed`.
[[nodiscard]] ProtocolParameter scoreField(const char* name, const QString& label, std::span<const char* const> words,
                                           const QString& needed, int from = 1);
/// The sessions of a study, "session"; first chosen is the last one of `code`, else the last of all.
[[nodiscard]] ProtocolParameter sessionField(const Study& study, const QString& code);

}  // namespace tacto::gui
