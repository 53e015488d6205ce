#include "drivers/sigrok/driver/ConfigValues.h"

#include <algorithm>

namespace tacto::sigrok_driver {

namespace {

/// Returns the list of values that the device offers for `key`, or nothing.
std::optional<Glib::VariantContainerBase> listOf(const sigrok::Configurable& on,
                                                 const sigrok::ConfigKey* key) noexcept {
    const auto list = guarded("list", [&]() -> std::optional<Glib::VariantContainerBase> {
        if (!on.config_check(key, sigrok::Capability::LIST)) return std::nullopt;
        return on.config_list(key);
    });
    return list ? *list : std::nullopt;
}

std::vector<std::uint64_t> fixedNumbers(GVariant* array) {
    gsize count = 0;
    if (!g_variant_is_of_type(array, G_VARIANT_TYPE("at"))) return {};
    const auto* const numbers =
        static_cast<const std::uint64_t*>(g_variant_get_fixed_array(array, &count, sizeof(std::uint64_t)));
    return {numbers, numbers + count};
}

GVariant* raw(const Glib::VariantBase& value) {
    return const_cast<GVariant*>(value.gobj());
}  // NOLINT: GLib has no const

}  // namespace

bool canSet(const sigrok::Configurable& on, const sigrok::ConfigKey* key) noexcept {
    const auto can = guarded("check", [&] { return on.config_check(key, sigrok::Capability::SET); });
    return can && *can;
}

std::vector<Fraction> fractionsOf(const sigrok::Configurable& on, const sigrok::ConfigKey* key) noexcept {
    std::vector<Fraction> fractions;
    const auto list = listOf(on, key);
    if (!list || !canSet(on, key) || !g_variant_is_container(raw(*list))) return fractions;
    // Some drivers list the fractions as an array, most as a tuple.
    for (gsize i = 0; i < g_variant_n_children(raw(*list)); ++i) {
        const std::unique_ptr<GVariant, void (*)(GVariant*)> one(g_variant_get_child_value(raw(*list), i),
                                                                 g_variant_unref);
        if (!g_variant_is_of_type(one.get(), G_VARIANT_TYPE("(tt)"))) return {};
        guint64 p = 0;
        guint64 q = 0;
        g_variant_get(one.get(), "(tt)", &p, &q);
        if (p > 0 && q > 0) fractions.push_back({p, q});
    }
    return fractions;
}

std::vector<std::uint64_t> numbersOf(const sigrok::Configurable& on, const sigrok::ConfigKey* key) noexcept {
    const auto list = listOf(on, key);
    if (!list || !canSet(on, key)) return {};
    return fixedNumbers(raw(*list));
}

std::vector<std::string> textsOf(const sigrok::Configurable& on, const sigrok::ConfigKey* key) noexcept {
    std::vector<std::string> texts;
    const auto list = listOf(on, key);
    if (!list || !canSet(on, key) || !g_variant_is_of_type(raw(*list), G_VARIANT_TYPE("as"))) return texts;
    for (gsize i = 0; i < g_variant_n_children(raw(*list)); ++i) {
        const std::unique_ptr<GVariant, void (*)(GVariant*)> one(g_variant_get_child_value(raw(*list), i),
                                                                 g_variant_unref);
        texts.emplace_back(g_variant_get_string(one.get(), nullptr));
    }
    return texts;
}

std::optional<std::uint64_t> numberOf(const sigrok::Configurable& on, const sigrok::ConfigKey* key) noexcept {
    const auto value = guarded("get", [&]() -> std::optional<std::uint64_t> {
        if (!on.config_check(key, sigrok::Capability::GET)) return std::nullopt;
        const auto got = on.config_get(key);
        if (g_variant_is_of_type(raw(got), G_VARIANT_TYPE_UINT64)) return g_variant_get_uint64(raw(got));
        if (g_variant_is_of_type(raw(got), G_VARIANT_TYPE_INT32)) {
            const auto number = g_variant_get_int32(raw(got));
            return number >= 0 ? std::optional(static_cast<std::uint64_t>(number)) : std::nullopt;
        }
        return std::nullopt;
    });
    return value ? *value : std::nullopt;
}

void readRates(const sigrok::Configurable& on, Abilities& into) noexcept {
    if (!canSet(on, sigrok::ConfigKey::SAMPLERATE)) return;
    const auto list = listOf(on, sigrok::ConfigKey::SAMPLERATE);
    if (!list || !g_variant_is_of_type(raw(*list), G_VARIANT_TYPE_VARDICT)) return;
    const auto entry = [&](const char* name) -> std::vector<std::uint64_t> {
        GVariant* const found = g_variant_lookup_value(raw(*list), name, G_VARIANT_TYPE("at"));
        if (found == nullptr) return {};
        auto numbers = fixedNumbers(found);
        g_variant_unref(found);
        return numbers;
    };
    if (const auto rates = entry("samplerates"); !rates.empty()) {
        for (const auto rate : rates) into.rates_hz.push_back(static_cast<double>(rate));
        into.rateMin_hz = *std::ranges::min_element(into.rates_hz);
        into.rateMax_hz = *std::ranges::max_element(into.rates_hz);
    } else if (const auto steps = entry("samplerate-steps"); steps.size() == 3) {
        into.rateMin_hz = static_cast<double>(steps[0]);
        into.rateMax_hz = static_cast<double>(steps[1]);
        into.rateStep_hz = static_cast<double>(steps[2]);
    }
}

Glib::VariantBase valueOf(const Fraction& fraction) {
    return Glib::VariantBase(g_variant_new("(tt)", guint64{fraction.p}, guint64{fraction.q}));
}
Glib::VariantBase valueOf(std::uint64_t number) { return Glib::VariantBase(g_variant_new_uint64(number)); }
Glib::VariantBase valueOf(double number) { return Glib::VariantBase(g_variant_new_double(number)); }
Glib::VariantBase valueOf(const std::string& text) { return Glib::VariantBase(g_variant_new_string(text.c_str())); }

}  // namespace tacto::sigrok_driver
