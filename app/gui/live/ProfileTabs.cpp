#include "app/gui/live/ProfileTabs.h"

#include <QCoreApplication>
#include <QScrollBar>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "app/gui/theme/Pages.h"
#include "app/gui/theme/Text.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/TypedNumber.h"
#include "core/bench/Profile.h"

namespace tacto::gui {

namespace {

FormField formFieldOf(const ProfileField& field) {
    if (!field.isChoice()) {
        auto number = textField(field.key, profileWords(field.label), {}, profileWords(field.tip));
        number.range = field.range();
        return number;
    }
    std::vector<std::pair<QString, QString>> choices;
    for (std::size_t i = 0; i < field.words.size(); ++i)
        choices.emplace_back(qtext(field.stored->words[i]), profileWords(field.words[i]));
    return choiceField(field.key, profileWords(field.label), choices, profileWords(field.tip));
}

/// What the profile says of the electrode beside its area and name (ElectrodeDescription).
struct ElectrodeText {
    const char *name, *key;
};
constexpr ElectrodeText kElectrodeTexts[] = {{"electrode_material", "material"}, {"electrode_medium", "medium"}};

}  // namespace

ProfileTabs::ProfileTabs(QWidget* parent) : QTabWidget(parent) {
    for (int tab = 0; tab < kProfileTabs; ++tab)
        addTab(buildTab(static_cast<ProfileTab>(tab)), titleOf(static_cast<ProfileTab>(tab)));
}

QWidget* ProfileTabs::buildTab(ProfileTab tab) {
    auto* page = new QWidget;
    auto*& form = forms_[std::size_t(tab)] = new FieldForm(page, FieldForm::Labels::Beside);
    std::vector<FormField> fields;
    for (const auto& field : profileForm())
        if (field.tab == tab) fields.push_back(formFieldOf(field));
    if (tab == ProfileTab::Load) {
        const auto tip = tr("Recorded and reported with the electrode's name and area; decides nothing.");
        const QString labels[] = {tr("Electrode material"), tr("Between electrode and skin")};
        const QString hints[] = {tr("as Ag/AgCl"), tr("as hydrogel")};
        for (std::size_t i = 0; i < std::size(kElectrodeTexts); ++i)
            fields.push_back(textField(kElectrodeTexts[i].name, labels[i], {}, tip, hints[i]));
    }
    form->show(fields);
    connect(form, &FieldForm::edited, this, &ProfileTabs::edited);
    auto* column = new QVBoxLayout(page);
    column->addWidget(form);
    column->addStretch(1);
    auto* area = scrollingRows(page, this);
    area->setMinimumWidth(page->sizeHint().width() + area->verticalScrollBar()->sizeHint().width());
    return area;
}

void ProfileTabs::goTo(const QString& key) {
    for (const auto& field : profileForm()) {
        if (field.key != key) continue;
        setCurrentIndex(int(field.tab));
        formOf(field).goTo(field.key);
    }
}

void ProfileTabs::fill(const nlohmann::json& document) {
    for (const auto& field : profileForm()) {
        const auto& value = document.at(field.section()).at(field.key);
        formOf(field).set(field.key, value.is_string() ? qtext(value.get<std::string>())
                                     : value.is_number()
                                         ? QString::number(value.get<double>(), 'g', QLocale::FloatingPointShortest)
                                         : QString());
    }
    const auto electrode = document.value("electrode", nlohmann::json::object());
    const auto text = [&](const char* key) { return qtext(electrode.value(key, std::string())); };
    auto& load = *forms_[std::size_t(ProfileTab::Load)];
    load.nameElectrode(text("name"));
    for (const auto& each : kElectrodeTexts) load.set(each.name, text(each.key));
}

std::optional<ProfileTabs::Refusal> ProfileTabs::read(nlohmann::json& document) const {
    for (const auto& field : profileForm()) {
        auto& value = document[field.section()][field.key];
        const auto text = formOf(field).text(field.key);
        if (field.isChoice()) {
            value = text.toStdString();
            continue;
        }
        if (text.isEmpty() && field.stored->mayBeNull) {
            value = nullptr;
            continue;
        }
        const auto number = typedNumber(text.toStdString());
        if (!number || !std::isfinite(*number))
            return Refusal{&field, tr("\"%1\" is not a number; %2 is expected").arg(text, field.range()) +
                                       qtext(typedTrouble(text.toStdString()))};
        value = *number;
    }
    const auto& load = *forms_[std::size_t(ProfileTab::Load)];
    nlohmann::json electrode{{"name", load.electrode().value_or(QString()).toStdString()}};
    for (const auto& each : kElectrodeTexts) electrode[each.key] = load.text(each.name).trimmed().toStdString();
    document.erase("electrode");
    if (std::ranges::any_of(electrode, [](const auto& text) { return text != ""; })) document["electrode"] = electrode;
    return std::nullopt;
}

void ProfileTabs::mark(const ProfileField* refused, const QString& refusal) {
    for (const auto& field : profileForm()) {
        auto& form = formOf(field);
        form.refuse(field.key, &field == refused ? refusal : QString());
        if (field.needs == nullptr) continue;
        const auto chosen = form.text(field.needs);
        const QString needed = field.needsValue;
        const bool matters = needed.startsWith('!') ? chosen != needed.mid(1) : chosen == needed;
        form.setFieldEnabled(field.key, matters || &field == refused);  // a refused field can always be corrected
    }
    for (int tab = 0; tab < kProfileTabs; ++tab) {
        const bool wrong = refused != nullptr && int(refused->tab) == tab;
        setTabText(tab, titleOf(static_cast<ProfileTab>(tab)) + (wrong ? " ⚠" : ""));
    }
}

namespace {

#define WORDS(text) QT_TRANSLATE_NOOP("Profile", text)

using Tab = ProfileTab;
const std::vector<const char*> kCurves{WORDS("linear"), WORDS("logarithmic"), WORDS("power, x^(1/β)")};

ProfileField described(Tab tab, const char* key, const char* label, const char* tip,
                       std::vector<const char*> words = {}, const char* accepts = nullptr, const char* needs = nullptr,
                       const char* needsValue = nullptr) {
    return {tab, key, label, tip, std::move(words), accepts, needs, needsValue};
}

std::vector<ProfileField> describedFields() {
    return {
        described(Tab::Encoding, "assignment", WORDS("Assignment"),
                  WORDS("Which feeling sets which part of the train."),
                  {WORDS("R → amplitude, P → interval"), WORDS("P → amplitude, R → interval")}),
        described(Tab::Encoding, "amplitude_min_v", WORDS("Smallest amplitude"),
                  WORDS("At index 0: the smoothest surface, or when swapped the lightest touch.")),
        described(Tab::Encoding, "amplitude_max_v", WORDS("Largest amplitude"),
                  WORDS("At index 1. The output limits always apply.")),
        described(Tab::Encoding, "amplitude_curve", WORDS("Its curve"),
                  WORDS("The course from the smallest to the largest amplitude."), kCurves),
        described(Tab::Encoding, "amplitude_beta", WORDS("Its exponent β"),
                  WORDS("Exponent of the power curve: above 1 the low end rises faster."), {}, nullptr,
                  "amplitude_curve", "power"),
        described(
            Tab::Encoding, "amplitude_ratio_per_train", WORDS("Largest ratio of amplitudes"),
            WORDS("From one train to the next, either way; 1.21 is two just-noticeable differences. 0: no limit."), {},
            WORDS("0, or above 1 to 1000")),
        described(Tab::Encoding, "amplitude_slew_v_per_s", WORDS("Largest change of amplitude"),
                  WORDS("From one train to the next, per second between them. 0: no limit.")),
        described(
            Tab::Encoding, "hold", WORDS("Held when the impedance changes"),
            WORDS(
                "Voltage: the amplitude stays as encoded. Charge per phase or energy per pulse: the amplitude follows "
                "the impedance from where it was when armed, within the limits."),
            {WORDS("voltage"), WORDS("charge per phase"), WORDS("energy per pulse")}),
        described(Tab::Encoding, "interval_min_s", WORDS("Shortest interval"),
                  WORDS("At index 1, from onset to onset. Longer than a train lasts.")),
        described(Tab::Encoding, "interval_max_s", WORDS("Longest interval"),
                  WORDS("At index 0, from onset to onset.")),
        described(Tab::Encoding, "interval_curve", WORDS("Its curve"),
                  WORDS("The course from the longest to the shortest interval."), kCurves),
        described(Tab::Encoding, "interval_beta", WORDS("Its exponent β"),
                  WORDS("Exponent of the power curve: above 1 the low end falls faster."), {}, nullptr,
                  "interval_curve", "power"),
        described(
            Tab::Encoding, "interval_ratio_per_train", WORDS("Largest ratio of intervals"),
            WORDS("From one interval to the next, either way; 1.3456 is two just-noticeable differences. 0: no limit."),
            {}, WORDS("0, or above 1 to 1000")),

        described(
            Tab::Pulse, "shape", WORDS("Shape"), WORDS("Biphasic pulses take back the charge of their first phase."),
            {WORDS("biphasic, symmetric"), WORDS("biphasic, asymmetric"), WORDS("monophasic (bench loads only)")}),
        described(Tab::Pulse, "polarity", WORDS("Leading phase"), WORDS("Sign of the first phase."),
                  {WORDS("positive"), WORDS("negative")}),
        described(Tab::Pulse, "phase_width_us", WORDS("Phase width"), WORDS("Duration of the leading phase.")),
        described(Tab::Pulse, "inter_phase_gap_us", WORDS("Inter-phase gap"),
                  WORDS("From the end of the first phase to the second."), {}, nullptr, "shape", "!monophasic"),
        described(Tab::Pulse, "recharge_ratio", WORDS("Recharge ratio"),
                  WORDS("The second phase is this many times longer and lower, with the same charge."), {},
                  WORDS("above 1 to 1000"), "shape", "asymmetric"),
        described(Tab::Pulse, "pulses", WORDS("Pulses in a train"), WORDS("A whole number.")),
        described(Tab::Pulse, "rate_hz", WORDS("Intra-train rate"),
                  WORDS("Rate of the pulses within a train. A train lasts pulses / rate.")),

        described(Tab::Touch, "spectral_feature", WORDS("From the vibration"),
                  WORDS("The share of the rough band in the vibration, or its power for the force."),
                  {WORDS("share of the rough band"), WORDS("power for the force")}),
        described(Tab::Touch, "band_low_hz", WORDS("Rough band from"), WORDS("Its upper end is 1 kHz.")),
        described(Tab::Touch, "spectral_weight", WORDS("Weight of the vibration"),
                  WORDS("Against the weight of the taxels.")),
        described(Tab::Touch, "taxel_feature", WORDS("From the taxels"),
                  WORDS("How unevenly they are pressed, or how unevenly they change."),
                  {WORDS("unevenness"), WORDS("unevenness of change")}),
        described(Tab::Touch, "taxel_weight", WORDS("Weight of the taxels"),
                  WORDS("Against the weight of the vibration.")),
        described(Tab::Touch, "smoothing_s", WORDS("Smoothing of R"),
                  WORDS("Time constant: longer is calmer and later.")),
        described(Tab::Touch, "contact_area_cm2", WORDS("Contact area"),
                  WORDS("Turns force into pressure where there are no taxels in Pa.")),
        described(Tab::Touch, "pressure_min_pa", WORDS("Pressure of P = 0"), WORDS("Lighter touches count as 0.")),
        described(Tab::Touch, "pressure_max_pa", WORDS("Pressure of P = 1"), WORDS("Firmer touches count as 1."), {},
                  WORDS("Pa, above that of P = 0")),

        described(Tab::Load, "load_low_ohm", WORDS("Smallest load"),
                  WORDS("The range in which a person's impedance must lie, and the worst case of previews.")),
        described(Tab::Load, "load_high_ohm", WORDS("Largest load"),
                  WORDS("The range in which a person's impedance must lie.")),
        described(Tab::Load, "electrode_area_cm2", WORDS("Electrode area"),
                  WORDS("Area of the smaller electrode. Without it, limits of density are not evaluated.")),
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
    const QString titles[kProfileTabs] = {QObject::tr("&Encoding"), QObject::tr("&Pulse train"), QObject::tr("&Touch"),
                                          QObject::tr("&Load")};
    return titles[static_cast<std::size_t>(tab)];
}

const char* ProfileField::section() const noexcept {
    return tab == ProfileTab::Touch ? "roughness" : tab == ProfileTab::Load ? "safety" : "encoding";
}

QString ProfileField::range() const {
    if (isChoice()) return {};
    if (accepts != nullptr) return profileWords(accepts);
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
    // A blank separates the unit from a word; a non-breaking space separates it from a number.
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

#include "moc_ProfileTabs.cpp"
