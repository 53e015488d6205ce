// ConfigValues.h - libsigrok's configuration keys as plain values.
//
// If the device does not answer a question, the functions return an empty list or nothing: the device does not offer
// that setting.
//
// Thread-safety: the instrument's thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "drivers/sigrok/protocol/Abilities.h"
#include "drivers/sigrok/transport/SigrokLibrary.h"

namespace tacto::sigrok_driver {

[[nodiscard]] bool canSet(const sigrok::Configurable& on, const sigrok::ConfigKey* key) noexcept;
[[nodiscard]] std::vector<Fraction> fractionsOf(const sigrok::Configurable& on, const sigrok::ConfigKey* key) noexcept;
[[nodiscard]] std::vector<std::uint64_t> numbersOf(const sigrok::Configurable& on,
                                                   const sigrok::ConfigKey* key) noexcept;
[[nodiscard]] std::vector<std::string> textsOf(const sigrok::Configurable& on, const sigrok::ConfigKey* key) noexcept;
[[nodiscard]] std::optional<std::uint64_t> numberOf(const sigrok::Configurable& on,
                                                    const sigrok::ConfigKey* key) noexcept;
/// Fills in the sampling rates of `into`.
void readRates(const sigrok::Configurable& on, Abilities& into) noexcept;

/// Values for config_set(). These functions throw libsigrok's exceptions.
[[nodiscard]] Glib::VariantBase valueOf(const Fraction& fraction);
[[nodiscard]] Glib::VariantBase valueOf(std::uint64_t number);
[[nodiscard]] Glib::VariantBase valueOf(double number);
[[nodiscard]] Glib::VariantBase valueOf(const std::string& text);

}  // namespace tacto::sigrok_driver
