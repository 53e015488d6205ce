#include "app/gui/study/StudyForm.h"

#include <QApplication>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/ToolRow.h"
#include "app/run/StudyProgram.h"

namespace tacto::gui {

namespace {

#define WORDS(text) QT_TRANSLATE_NOOP("Study", text)

using Group = StudyGroup;

constexpr int kTwoFormColumns = 700;

QString translated(const char* text) { return QCoreApplication::translate("Study", text); }

constexpr const char* kGroupTitles[kStudyGroups] = {WORDS("Approval"), WORDS("Participants"), WORDS("Electrodes"),
                                                    WORDS("Train"), WORDS("Test")};

std::vector<StudyFormField> describedFields() {
    return {
        {Group::Approval, "title", WORDS("Title"), WORDS("As the committee knows the study. It is not sealed."),
         WORDS("the study has no title")},
        {Group::Approval, "approval.reference", WORDS("Reference of the approval"),
         WORDS("As the ethics committee wrote it. Without one no session begins."), WORDS("no session can begin")},
        {Group::Approval, "approval.committee", WORDS("Committee"), WORDS("Who approved it. May be left empty.")},
        {Group::Approval, "approval.from", WORDS("First day"), WORDS("From this day on sessions can begin."),
         WORDS("no session can begin")},
        {Group::Approval, "approval.expires", WORDS("Last day"), WORDS("After this day no session begins."),
         WORDS("no session can begin")},
        {Group::Approval, "approval.protocol_version", WORDS("Version of the study plan"),
         WORDS("The one that was approved. May be left empty.")},
        {Group::Approval, "consent_version", WORDS("Version of the consent form"),
         WORDS("The one in force. Each participant consents to it before their first session."),
         WORDS("no consent can be noted")},
        {Group::Approval,
         "data_on_request",
         WORDS("Data of participants who withdraw"),
         WORDS("As the consent form promises. “Destroyed”: their key is destroyed, and their data cannot be opened."),
         nullptr,
         {WORDS("are destroyed"), WORDS("are kept")}},
        {Group::Approval, "license", WORDS("License of exports"),
         WORDS("Under which others may use exported results: CC-BY-4.0. May be left empty.")},

        {Group::Participants, "participants_max", WORDS("Participants at most"),
         WORDS("As many as the approval allows. Those who left count too.")},
        {Group::Participants, "sessions_max", WORDS("Sessions of each at most"), WORDS("As the approval allows.")},
        {Group::Participants, "age_min", WORDS("Age at least"), WORDS("In years, as the approval allows.")},
        {Group::Participants, "exclusions", WORDS("More exclusion questions"),
         WORDS("Your own, each answered with no before a session. Separate them with semicolons.")},
        {Group::Participants, "gap_min_h", WORDS("Between two sessions at least"),
         WORDS("From the first train of one session to the start of the next.")},
        {Group::Participants, "session_max_min", WORDS("A session at most"), WORDS("As the approval allows.")},

        {Group::Site,
         "modality",
         WORDS("Felt through"),
         WORDS("The output device that the participant feels."),
         nullptr,
         {WORDS("electrodes"), WORDS("massager")}},
        {Group::Site,
         "site",
         WORDS("Site"),
         WORDS("Chest, neck and head cannot be chosen."),
         nullptr,
         {WORDS("forearm"), WORDS("residual limb’s end"), WORDS("upper arm"), WORDS("hand")}},
        {Group::Site,
         "nerve",
         WORDS("Over the nerve"),
         WORDS("Both electrodes lie over it."),
         nullptr,
         {WORDS("radial"), WORDS("median"), WORDS("ulnar")}},
        {Group::Site,
         "limb",
         WORDS("Side"),
         WORDS("Both electrodes lie on one limb."),
         nullptr,
         {WORDS("left"), WORDS("right")}},
        {Group::Site, "electrode.type", WORDS("Electrodes"), WORDS("Kind or product.")},
        {Group::Site, "electrode.area_cm2", WORDS("Area of one"),
         WORDS("Area of the smaller electrode. Density limits use it.")},
        {Group::Site, "electrode.distance_mm", WORDS("Distance"), WORDS("From centre to centre.")},

        {Group::Train, "cap_ma", WORDS("Current at most"),
         WORDS("No level is above it, even if other limits allow more.")},
        {Group::Train, "train.width_us", WORDS("Phase width"), WORDS("Duration of one phase.")},
        {Group::Train, "train.gap_us", WORDS("Inter-phase gap"), WORDS("From one phase to the other.")},
        {Group::Train, "train.pulses", WORDS("Pulses in a train"), WORDS("A whole number.")},
        {Group::Train, "train.rate_hz", WORDS("Rate in the train"), WORDS("0 where a train has one pulse.")},

        {Group::Test, "encodings", WORDS("Encodings"), WORDS("In the swapped one texture and pressure change places.")},
        {Group::Test,
         "procedure.method",
         WORDS("Detection by"),
         WORDS("Every session asks by this method."),
         nullptr,
         {WORDS("QUEST+"), WORDS("weighted staircase")}},
        {Group::Test, "procedure.comparison", WORDS("Weber fraction of strength"),
         WORDS("Sessions of thresholds measure it too, by 40 trials.")},
        {Group::Test, "blocks", WORDS("Blocks"), WORDS("Number of test blocks, with breaks in between.")},
        {Group::Test, "per_condition", WORDS("Trials of each condition"), WORDS("In a block.")},
        {Group::Test, "catch", WORDS("Empty trials"), WORDS("In a block. The right answer is “nothing”.")},
        {Group::Test, "pain_ceiling", WORDS("Pain ceiling"),
         WORDS("From this rating of 10 on, the operator answers by name before the next presentation.")},
        {Group::Test, "blind", WORDS("Conditions hidden from the operator"), WORDS("Until the session has ended.")},
    };
}

#undef WORDS

/// The field of the laboratory's own questions, which are separated by semicolons.
constexpr std::string_view kQuestions = "exclusions";

const FieldInfo* storedField(std::string_view key) {
    static const auto all = studyFields().kind().info;
    const auto dot = key.find('.');
    const auto* found = all.find(key.substr(0, dot));
    return found == nullptr || dot == std::string_view::npos ? found : found->find(key.substr(dot + 1));
}

nlohmann::json& memberOf(nlohmann::json& record, std::string_view key) {
    const auto dot = key.find('.');
    auto& outer = record[std::string(key.substr(0, dot))];
    return dot == std::string_view::npos ? outer : outer[std::string(key.substr(dot + 1))];
}

/// Returns the settings shown first. If the study's approval names no procedure, the amendment must name one.
StudySettings shownIn(const std::optional<StudySettings>& amended) {
    auto settings = amended.value_or(StudySettings{});
    if (!settings.procedure) settings.procedure.emplace();
    if (!settings.painCeiling) settings.painCeiling = kPainCeiling;
    if (!settings.ageMin) settings.ageMin = kAgeMin;
    return settings;
}

/// Returns the choices of encoding: one of them, or both. If the study `held` other encodings, they are added
/// unchanged.
std::vector<std::pair<std::string, std::string>> encodingChoices(const std::string& held) {
    const auto word = [](const char* text) { return translated(text).toStdString(); };
    std::vector<std::pair<std::string, std::string>> all{
        {"standard", word(QT_TRANSLATE_NOOP("Study", "standard"))},
        {"standard,swapped", word(QT_TRANSLATE_NOOP("Study", "standard, and swapped"))},
        {"swapped", word(QT_TRANSLATE_NOOP("Study", "swapped"))}};
    if (std::ranges::find(all, held, &std::pair<std::string, std::string>::first) == all.end())
        all.emplace_back(held, held);
    return all;
}

FormField formFieldOf(const StudyFormField& field, nlohmann::json defaults, bool isNew) {
    const auto& stored = *storedField(field.key);
    auto& value = memberOf(defaults, field.key);
    FormField shown{.parameter = {}, .tip = translated(field.tip)};
    auto& made = shown.parameter;
    made.name = field.key;
    made.label = translated(field.label).toStdString();
    if (field.needed != nullptr) made.needed = translated(field.needed).toStdString();
    if (!stored.words.empty()) {
        made.type = ParameterType::Choice;
        for (std::size_t i = 0; i < stored.words.size(); ++i)
            made.choices.emplace_back(stored.words[i], i < field.words.size() ? translated(field.words[i]).toStdString()
                                                                              : std::string(stored.words[i]));
        made.value = value;
    } else if (stored.numbers) {
        made.type = stored.numbers->whole ? ParameterType::Integer : ParameterType::Number;
        made.unit = stored.numbers->unit;
        made.min = stored.numbers->low;
        made.max = stored.numbers->high;
        made.value = value;
    } else if (value.is_boolean()) {
        made.type = ParameterType::Boolean;
        made.value = value;
    } else if (value.is_array()) {
        const bool questions = field.key == kQuestions;
        made.type = questions ? ParameterType::Text : ParameterType::Choice;
        std::string all;
        for (const auto& each : value) all += (all.empty() ? "" : questions ? "; " : ",") + each.get<std::string>();
        if (!questions) made.choices = encodingChoices(all);
        made.value = all;
    } else {
        const bool day = field.key == "approval.from" || field.key == "approval.expires";
        made.type = day ? ParameterType::Date : ParameterType::Text;
        made.value = day && isNew ? nlohmann::json("") : value;
    }
    return shown;
}

}  // namespace

const std::vector<StudyFormField>& studyForm() {
    static const auto all = describedFields();
    return all;
}

StudyForm::StudyForm(QWidget* parent) : QWidget(parent) {
    // One column if two are too narrow for their words.
    auto* both = new TurningRow([] { return scaledPx(kTwoFormColumns) + 1; }, this);
    both->setContentsMargins(0, 0, 0, 0);
    both->setSpacing(scaledPx(32));
    QVBoxLayout* columns[] = {new QVBoxLayout, new QVBoxLayout};
    for (auto* column : columns) {
        both->addLayout(column, 1);
        column->setSpacing(scaledPx(8));  // unlike the row's spacing
    }
    for (int g = 0; g < kStudyGroups; ++g) {
        auto* column = columns[g < 2 ? 0 : 1];
        column->addWidget(strongLabel(translated(kGroupTitles[g]), this));
        auto* form = new FieldForm(this);
        connect(form, &FieldForm::edited, this, &StudyForm::edited);
        form->setMissingSaidOnceLeft();
        column->addWidget(form);
        column->addSpacing(scaledPx(16));
        groups_.push_back(form);
    }
    for (auto* column : columns) column->addStretch();
    clear();
}

void StudyForm::clear() {
    amended_.reset();
    fill();
}

void StudyForm::amend(const StudySettings& settings) {
    amended_ = settings;
    fill();
}

void StudyForm::fill() {
    auto shown = shownIn(amended_);
    shown.approval.reference.clear();
    const auto values = studyFields().write(shown);
    for (int g = 0; g < kStudyGroups; ++g) {
        std::vector<FormField> fields;
        for (const auto& field : studyForm()) {
            if (int(field.group) != g) continue;
            fields.push_back(formFieldOf(field, values, !amended_));
            if (amended_ && field.key == "approval.reference")
                fields.back().parameter.label = tr("Reference of the amendment").toStdString();
        }
        groups_[std::size_t(g)]->show(fields);
    }
}

void StudyForm::set(const std::string& key, const QString& text) {
    for (auto* form : groups_) form->set(key, text);
}

Result<StudySettings> StudyForm::read(const Profile& profile, const QString& folder) {
    const auto settings = shownIn(amended_);
    auto json = studyFields().write(settings);
    for (auto* form : groups_) {
        if (const auto wrong = form->wrong(); !wrong.isEmpty())
            return fail(ErrorCode::InvalidArgument, "{}", wrong.toStdString());
        const auto read = form->read();
        if (!read) return failure(read);
        for (const auto& [key, value] : read->parameters.items()) {
            auto& into = memberOf(json, key);
            if (!into.is_array()) {
                into = value;
                continue;
            }
            into = nlohmann::json::array();
            const QChar between = key == kQuestions ? u';' : u',';
            for (const auto& part : qtext(value.get<std::string>()).split(between, Qt::SkipEmptyParts))
                if (!part.trimmed().isEmpty()) into.push_back(part.trimmed().toStdString());
        }
    }
    auto filled = studyFields().read(json, RecordPlace{});
    if (!filled) return tl::unexpected<Error>(asInvalidArgument(filled.error()));
    if (auto stated = stateProgram(*filled, profile, folder.toStdString()); !stated) return failure(stated);
    return filled;
}

}  // namespace tacto::gui

#include "moc_StudyForm.cpp"
