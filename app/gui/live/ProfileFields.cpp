#include "app/gui/live/ProfileFields.h"

#include <QCoreApplication>

#include "app/gui/theme/Text.h"
#include "core/bench/Profile.h"

namespace tacto::gui {

namespace {

#define WORDS(text) QT_TRANSLATE_NOOP("Profile", text)

using Tab = ProfileTab;
const std::vector<const char*> kCurves{WORDS("linear"), WORDS("logarithmic"), WORDS("power, x^(1/β)")};

std::vector<ProfileField> describedFields() {
    return {
        {Tab::Encoding,
         "assignment",
         WORDS("Assignment"),
         WORDS("Which feeling sets which part of the train."),
         {.words = {WORDS("R → amplitude, P → interval"), WORDS("P → amplitude, R → interval")}}},
        {Tab::Encoding, "amplitude_min_v", WORDS("Smallest amplitude"),
         WORDS("At index 0: the smoothest surface, or when swapped the lightest touch.")},
        {Tab::Encoding, "amplitude_max_v", WORDS("Largest amplitude"),
         WORDS("At index 1. The output limits always apply.")},
        {Tab::Encoding,
         "amplitude_curve",
         WORDS("Its curve"),
         WORDS("The course from the smallest to the largest amplitude."),
         {.words = kCurves}},
        {Tab::Encoding,
         "amplitude_beta",
         WORDS("Its exponent β"),
         WORDS("Exponent of the power curve: above 1 the low end rises faster."),
         {.needs = "amplitude_curve", .needsValue = "power"}},
        {Tab::Encoding,
         "amplitude_ratio_per_train",
         WORDS("Largest ratio of amplitudes"),
         WORDS("From one train to the next, either way; 1.21 is two just-noticeable differences. 0: no limit."),
         {.accepts = WORDS("0, or above 1 to 1000")}},
        {Tab::Encoding, "amplitude_slew_v_per_s", WORDS("Largest change of amplitude"),
         WORDS("From one train to the next, per second between them. 0: no limit.")},
        {Tab::Encoding,
         "hold",
         WORDS("Held when the impedance changes"),
         WORDS("Voltage: the amplitude stays as encoded. Charge per phase or energy per pulse: the amplitude follows "
               "the impedance from where it was when armed, within the limits."),
         {.words = {WORDS("voltage"), WORDS("charge per phase"), WORDS("energy per pulse")}}},
        {Tab::Encoding, "interval_min_s", WORDS("Shortest interval"),
         WORDS("At index 1, from onset to onset. Longer than a train lasts.")},
        {Tab::Encoding, "interval_max_s", WORDS("Longest interval"), WORDS("At index 0, from onset to onset.")},
        {Tab::Encoding,
         "interval_curve",
         WORDS("Its curve"),
         WORDS("The course from the longest to the shortest interval."),
         {.words = kCurves}},
        {Tab::Encoding,
         "interval_beta",
         WORDS("Its exponent β"),
         WORDS("Exponent of the power curve: above 1 the low end falls faster."),
         {.needs = "interval_curve", .needsValue = "power"}},
        {Tab::Encoding,
         "interval_ratio_per_train",
         WORDS("Largest ratio of intervals"),
         WORDS("From one interval to the next, either way; 1.3456 is two just-noticeable differences. 0: no limit."),
         {.accepts = WORDS("0, or above 1 to 1000")}},

        {Tab::Pulse,
         "shape",
         WORDS("Shape"),
         WORDS("Biphasic pulses take back the charge of their first phase."),
         {.words = {WORDS("biphasic, symmetric"), WORDS("biphasic, asymmetric"),
                    WORDS("monophasic (bench loads only)")}}},
        {Tab::Pulse,
         "polarity",
         WORDS("Leading phase"),
         WORDS("Sign of the first phase."),
         {.words = {WORDS("positive"), WORDS("negative")}}},
        {Tab::Pulse, "phase_width_us", WORDS("Phase width"), WORDS("Duration of the leading phase.")},
        {Tab::Pulse,
         "inter_phase_gap_us",
         WORDS("Inter-phase gap"),
         WORDS("From the end of the first phase to the second."),
         {.needs = "shape", .needsValue = "!monophasic"}},
        {Tab::Pulse,
         "recharge_ratio",
         WORDS("Recharge ratio"),
         WORDS("The second phase is this many times longer and lower, with the same charge."),
         {.accepts = WORDS("above 1 to 1000"), .needs = "shape", .needsValue = "asymmetric"}},
        {Tab::Pulse, "pulses", WORDS("Pulses in a train"), WORDS("A whole number.")},
        {Tab::Pulse, "rate_hz", WORDS("Intra-train rate"),
         WORDS("Rate of the pulses within a train. A train lasts pulses / rate.")},

        {Tab::Touch,
         "spectral_feature",
         WORDS("From the vibration"),
         WORDS("The share of the rough band in the vibration, or its power for the force."),
         {.words = {WORDS("share of the rough band"), WORDS("power for the force")}}},
        {Tab::Touch, "band_low_hz", WORDS("Rough band from"), WORDS("Its upper end is 1 kHz.")},
        {Tab::Touch, "spectral_weight", WORDS("Weight of the vibration"), WORDS("Against the weight of the taxels.")},
        {Tab::Touch,
         "taxel_feature",
         WORDS("From the taxels"),
         WORDS("How unevenly they are pressed, or how unevenly they change."),
         {.words = {WORDS("unevenness"), WORDS("unevenness of change")}}},
        {Tab::Touch, "taxel_weight", WORDS("Weight of the taxels"), WORDS("Against the weight of the vibration.")},
        {Tab::Touch, "smoothing_s", WORDS("Smoothing of R"), WORDS("Time constant: longer is calmer and later.")},
        {Tab::Touch, "contact_area_cm2", WORDS("Contact area"),
         WORDS("Turns force into pressure where there are no taxels in Pa.")},
        {Tab::Touch, "pressure_min_pa", WORDS("Pressure of P = 0"), WORDS("Lighter touches count as 0.")},
        {Tab::Touch,
         "pressure_max_pa",
         WORDS("Pressure of P = 1"),
         WORDS("Firmer touches count as 1."),
         {.accepts = WORDS("Pa, above that of P = 0")}},

        {Tab::Load, "load_low_ohm", WORDS("Smallest load"),
         WORDS("The range in which a person's impedance must lie, and the worst case of previews.")},
        {Tab::Load, "load_high_ohm", WORDS("Largest load"), WORDS("The range in which a person's impedance must lie.")},
        {Tab::Load, "electrode_area_cm2", WORDS("Electrode area"),
         WORDS("Area of the smaller electrode. Without it, limits of density are not evaluated.")},
    };
}

#undef WORDS

}  // namespace

const std::vector<ProfileField>& profileForm() {
    static const auto all = [] {
        static const auto sections = profileFields().kind().info;
        auto fields = describedFields();
        for (auto& field : fields) field.stored = sections.find(field.section())->find(field.key);
        return fields;
    }();
    return all;
}

QString profileWords(const char* text) { return QCoreApplication::translate("Profile", text); }

QString titleOf(ProfileTab tab) {
    switch (tab) {
        case ProfileTab::Encoding:
            return QObject::tr("&Encoding");
        case ProfileTab::Pulse:
            return QObject::tr("&Pulse train");
        case ProfileTab::Touch:
            return QObject::tr("&Touch");
        case ProfileTab::Load:
            break;
    }
    return QObject::tr("&Load");
}

const char* ProfileField::section() const noexcept {
    switch (tab) {
        case ProfileTab::Touch:
            return "roughness";
        case ProfileTab::Load:
            return "safety";
        default:
            return "encoding";
    }
}

QString ProfileField::range() const {
    if (isChoice()) return {};
    if (form.accepts != nullptr) return profileWords(form.accepts);
    const auto& numbers = *stored->numbers;
    const auto from = grouped(QString::number(numbers.low, 'g', 10));
    const auto to = grouped(QString::number(numbers.high, 'g', 10));
    QString text;
    if (numbers.high >= 1e6)
        text = numbers.openLow ? QObject::tr("above %1").arg(from) : QObject::tr("%1 or more").arg(from);
    else
        text = (numbers.openLow    ? QObject::tr("above %1 to %2")
                : numbers.openHigh ? QObject::tr("%1 to below %2")
                                   : QObject::tr("%1 to %2"))
                   .arg(from, to);
    // After a word the unit stands apart; after a number no line breaks before it.
    if (!numbers.unit.empty()) text += (text.back().isDigit() ? QChar(0x202f) : QChar(' ')) + qtext(numbers.unit);
    return stored->mayBeNull ? QObject::tr("%1, or empty").arg(text) : text;
}

const ProfileField* fieldIn(const QString& refusal) {
    const ProfileField* found = nullptr;
    qsizetype first = refusal.size();
    for (const auto& field : profileForm()) {
        const QString key = field.key;
        for (const auto& name : {key, QString(key).replace('_', ' ')}) {
            const auto at = refusal.indexOf(name);
            if (at < 0 || at >= first) continue;
            first = at;
            found = &field;
        }
    }
    return found;
}

QString inFormWords(QString refusal) {
    for (const auto& field : profileForm()) {
        const auto section = QString(field.section()) + ": ";
        if (refusal.startsWith(section)) refusal.remove(0, section.size());
        const QRegularExpression key(QString(R"("?\b%1\b"?)").arg(field.key));
        refusal.replace(key, QString("“%1”").arg(profileWords(field.label)));
    }
    return sentence(grouped(refusal));
}

}  // namespace tacto::gui
