#include "app/gui/theme/FieldForm.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFocusEvent>
#include <QLineEdit>
#include <QToolButton>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/ElectrodeBox.h"
#include "app/gui/theme/EntryFields.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "core/base/JsonText.h"

namespace tacto::gui {

namespace {

constexpr int kLabelWidth = 280;  // pixels up to which a label does not wrap

QString shownUnit(const ProtocolParameter& parameter) {
    return axisUnit(0, QString::fromStdString(parameter.unit)).unit;
}

/// The range in the unit of the label, in which the user types: "0.5 to 10", never "500 ms to 10 s".
QString rangeText(const ProtocolParameter& parameter) {
    const auto text = [](double value) { return grouped(settingText(value, {})); };
    if (parameter.min && parameter.max) return QObject::tr("%1 to %2").arg(text(*parameter.min), text(*parameter.max));
    if (parameter.min) return QObject::tr("at least %1").arg(text(*parameter.min));
    if (parameter.max) return QObject::tr("at most %1").arg(text(*parameter.max));
    return {};
}

QString scriptsTip(const ProtocolParameter& parameter) {
    const auto range = rangeText(parameter);
    const auto takes = range.isEmpty()          ? QString()
                       : parameter.unit.empty() ? QObject::tr(" and takes %1").arg(range)
                                                : QObject::tr(" and takes %1 %2").arg(range, shownUnit(parameter));
    const auto zero =
        parameter.zero.empty() ? QString() : QObject::tr(" 0, or nothing: %1.").arg(qtext(parameter.zero));
    return QObject::tr("%1. The script calls it \"%2\"%3.").arg(qtext(parameter.label), qtext(parameter.name), takes) +
           zero;
}

/// Returns the words of a refusal with the parameter's label instead of its name in the script.
QString refusalText(const ProtocolParameter& parameter, const Error& refused) {
    auto words = qtext(refused.message);
    const auto name = qtext(parameter.name) + ' ';
    if (words.startsWith(name)) words.replace(0, name.size() - 1, QObject::tr("This"));
    return grouped(sentence(words));
}

QString plain(const nlohmann::json& value) {
    if (value.is_string()) return QString::fromStdString(value.get<std::string>());
    if (value.is_number()) return QString::number(value.get<double>(), 'g', 10);
    return QString::fromStdString(dumpJson(value));
}

/// The parameters, of protocols, a profile and a study, that are the area of an electrode.
constexpr std::string_view kElectrodeAreas[] = {"area", "electrode_area_cm2", "electrode.area_cm2"};

/// Returns the value as a field shows it; empty for 0 if 0 has a meaning of its own.
QString shown(const ProtocolParameter& parameter, const nlohmann::json& value) {
    return !parameter.zero.empty() && value == 0 ? QString() : plain(value);
}

void offer(QComboBox& box, const ProtocolParameter& parameter) {
    for (const auto& [key, text] : parameter.choices)
        box.addItem(withOhmSigns(qtext(text.empty() ? key : text)), qtext(key));
}

/// Converts choices (key and words) to the type that a parameter has.
std::vector<std::pair<std::string, std::string>> utf8(const std::vector<std::pair<QString, QString>>& choices) {
    std::vector<std::pair<std::string, std::string>> all;
    for (const auto& [key, words] : choices) all.emplace_back(key.toStdString(), words.toStdString());
    return all;
}

QFormLayout* rowsIn(QWidget& part, FieldForm::Labels labels) {
    auto* form = layoutIn<QFormLayout>(part, -1, {});
    form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    if (labels == FieldForm::Labels::Beside) form->setVerticalSpacing(8);
    form->setRowWrapPolicy(labels == FieldForm::Labels::Above ? QFormLayout::WrapAllRows  // for a narrow column
                                                              : QFormLayout::WrapLongRows);
    return form;
}

FormField described(const char* name, const QString& label, ParameterType type, nlohmann::json value,
                    const QString& tip) {
    FormField field;
    field.parameter.name = name;
    field.parameter.label = label.toStdString();
    field.parameter.type = type;
    field.parameter.value = std::move(value);
    field.tip = tip;
    return field;
}

}  // namespace

FormField choiceField(const char* name, const QString& label, const std::vector<std::pair<QString, QString>>& choices,
                      const QString& tip) {
    auto field = described(name, label, ParameterType::Choice, choices.front().first.toStdString(), tip);
    field.parameter.choices = utf8(choices);
    return field;
}

FormField textField(const char* name, const QString& label, const QString& value, const QString& tip,
                    const QString& hint) {
    auto field = described(name, label, ParameterType::Text, value.toStdString(), tip);
    field.hint = hint;
    return field;
}

FormField dayField(const char* name, const QString& label, const QString& tip, const QString& hint) {
    auto field = described(name, label, ParameterType::Date, "", tip);
    field.hint = hint;
    return field;
}

FormField numberField(const char* name, const QString& label, const char* unit, double least, double most, double value,
                      const QString& tip) {
    auto field = described(name, label, ParameterType::Number, value, tip);
    field.parameter.unit = unit;
    field.parameter.min = least;
    field.parameter.max = most;
    return field;
}

FormField wholeField(const char* name, const QString& label, int least, int most, int value, const QString& tip) {
    auto field = described(name, label, ParameterType::Integer, value, tip);
    field.parameter.min = least;
    field.parameter.max = most;
    return field;
}

FormField tickField(const char* name, const QString& label, bool value, const QString& tip) {
    return described(name, label, ParameterType::Boolean, value, tip);
}

FormField ownField(const QString& label, QWidget* own) {
    auto field = described("", label, ParameterType::Text, "", {});
    field.own = own;
    return field;
}

FieldForm::FieldForm(QWidget* parent, Labels labels)
    : QWidget(parent),
      labels_(labels),
      settingsRows_(rowsIn(*this, labels)),
      reference_(new QWidget(parent)),
      referenceRows_(rowsIn(*reference_, labels)) {
    reference_->hide();
    onFontChange(*this, [this] { fitLabels(); });
}

/// Wraps long labels, but not between two short words. Fields with a range end at the start of the widest range.
void FieldForm::fitLabels() {
    int widest = 0;
    for (const auto& field : fields_) {
        field.range->ensurePolished();
        field.range->setVisible(!field.range->text().isEmpty());
        if (!field.range->text().isEmpty()) widest = std::max(widest, field.range->sizeHint().width());
        if (field.label == nullptr || labels_ == Labels::Beside) continue;
        field.label->setMinimumWidth(
            std::min(scaledPx(kLabelWidth), 2 * fontMetrics().averageCharWidth() * int(field.label->text().size())));
    }
    for (const auto& field : fields_) {
        field.range->setMinimumWidth(widest);
    }
}

FieldForm::Field FieldForm::makeField(const FormField& described) {
    const auto& parameter = described.parameter;
    const auto takes = described.range.isEmpty() ? rangeText(parameter) : described.range;
    Field field{parameter, described.tip, described.hint, takes, {}, {}};
    if (parameter.type == ParameterType::Choice) {
        auto* box = new QComboBox(this);
        offer(*box, parameter);
        box->setCurrentIndex(box->findData(plain(parameter.value)));
        box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
        box->setMinimumContentsLength(8);  // characters; the box grows with the column
        box->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
        connect(box, &QComboBox::currentIndexChanged, this, &FieldForm::judge);
        field.text = [box] { return box->currentData().toString(); };
        field.write = [box](const QString& key) {
            if (const int index = box->findData(key); index >= 0) box->setCurrentIndex(index);
        };
        field.editor = box;
    } else if (parameter.type == ParameterType::Boolean) {
        auto* box = new QCheckBox(this);
        box->setChecked(parameter.value.is_boolean() && parameter.value.get<bool>());
        connect(box, &QCheckBox::toggled, this, &FieldForm::judge);
        field.text = [box] { return box->isChecked() ? QString("true") : QString("false"); };
        field.write = [box](const QString& word) { box->setChecked(word == "true"); };
        field.editor = box;
    } else {
        addLine(field);
    }
    if (field.whole == nullptr) field.whole = field.editor;
    field.editor->setObjectName(QString::fromStdString(parameter.name));
    field.editor->installEventFilter(this);
    field.editor->setAccessibleName(qtext(parameter.label).remove('&'));
    field.editor->setToolTip(described.tip);
    return field;
}

void FieldForm::addLine(Field& field) {
    QLineEdit* line = nullptr;
    if (field.parameter.type == ParameterType::Date) {
        auto* day = new DayField(QString::fromStdString(field.parameter.name),
                                 field.parameter.needed.empty() ? tr("not stated") : tr("as 2027-03-01"), this);
        field.whole = day;
        line = &day->line();
    } else {
        line = new QLineEdit(this);
    }
    line->setText(shown(field.parameter, field.parameter.value));
    if (!field.hint.isEmpty()) line->setPlaceholderText(field.hint);
    connect(line, &QLineEdit::textChanged, this, &FieldForm::judge);
    field.text = [line, zero = !field.parameter.zero.empty()] {
        return zero && line->text().trimmed().isEmpty() ? QString("0") : line->text();
    };
    field.write = [line](const QString& text) { line->setText(text); };
    field.editor = line;
    if (field.parameter.type == ParameterType::File) addFileChooser(field);
}

void FieldForm::addFileChooser(Field& field) {
    auto* line = static_cast<QLineEdit*>(field.editor);
    line->setPlaceholderText(tr("no file"));
    line->setClearButtonEnabled(true);
    auto* button = new QToolButton(this);
    button->setText("…");
    nameWidget(*button, "choose-" + QString::fromStdString(field.parameter.name), tr("Choose the file"),
               tr("Chooses a file."));
    const auto title = QString::fromStdString(field.parameter.label);
    connect(button, &QToolButton::clicked, this, [this, line, title] {
        FileQuestion question;
        question.title = title;
        askForFile(*this, question, [line](const QString& path) { line->setText(path); });
    });
    field.whole = new QWidget(this);
    placeInLine(*field.whole, *line, *button);
}

void FieldForm::show(const ProtocolDeclaration& declaration) {
    declaration_ = declaration;
    std::vector<FormField> fields;
    for (const auto& parameter : declaration.parameters) fields.push_back({parameter, scriptsTip(parameter)});
    showFields(fields);
}

void FieldForm::show(const std::vector<FormField>& fields) {
    declaration_ = {};
    for (const auto& field : fields)
        if (field.own == nullptr) declaration_.parameters.push_back(field.parameter);
    showFields(fields);
}

void FieldForm::showFields(const std::vector<FormField>& fields) {
    fields_.clear();
    for (auto* rows : {settingsRows_, referenceRows_}) {
        while (rows->rowCount() > 0) rows->removeRow(0);
    }
    for (const bool decisive : {true, false}) {
        for (const auto& described : fields) {
            if (described.parameter.needed.empty() == decisive) continue;
            if (described.own != nullptr) {
                addOwn(described);
                continue;
            }
            auto field = makeField(described);
            field.proposed = field.atFirst = field.text();
            addRow(field);
            fields_.push_back(std::move(field));
        }
    }
    if (settingsRows_->rowCount() == 0) {
        auto* none = makeLabel(tr("This protocol has nothing to set."), {.tone = Tone::Quiet, .wraps = true}, this);
        settingsRows_->addRow(none);
    }
    for (auto* part : {static_cast<QWidget*>(this), reference_}) tabInPlace(*part);
    fitLabels();
    judge();
}

void FieldForm::addOwn(const FormField& described) {
    described.own->setParent(this);  // this also sets its place in the tab order
    if (described.parameter.label.empty())
        settingsRows_->addRow(described.own);
    else
        settingsRows_->addRow(qtext(described.parameter.label), described.own);
}

void FieldForm::addRow(Field& field) {
    const auto& parameter = field.parameter;
    auto* column = field.row = new QWidget(this);
    auto* stack = columnIn(*column, 0);
    auto* line = new QHBoxLayout;
    const bool ticks = parameter.type == ParameterType::Boolean;
    line->addWidget(field.whole, ticks ? 0 : 1);
    if (ticks) line->addWidget(field.label = new QLabel(qtext(parameter.label), column), 1);
    field.range = new QLabel(field.takes, column);
    field.range->setTextFormat(Qt::PlainText);
    setTone(*field.range, Tone::Quiet);
    line->setSpacing(fontMetrics().averageCharWidth());
    line->addWidget(field.range);
    stack->addLayout(line);
    if (auto* area = qobject_cast<QLineEdit*>(field.editor);
        area && std::ranges::count(kElectrodeAreas, parameter.name)) {
        stack->addWidget(electrode_ = new ElectrodeBox(*area, column));
        connect(electrode_, &ElectrodeBox::currentTextChanged, this, &FieldForm::edited);
    }
    field.trouble = new TroubleLine("trouble-" + QString::fromStdString(parameter.name), column);
    stack->addWidget(field.trouble);
    auto label = QString::fromStdString(parameter.label);
    if (!parameter.unit.empty()) label += QString(" (%1)").arg(shownUnit(parameter));
    auto* rows = parameter.reference ? referenceRows_ : settingsRows_;
    if (ticks) {
        rows->addRow(column);
        field.label->installEventFilter(this);  // a click on the label ticks the box: the box's own text could not wrap
    } else {
        rows->addRow(label, column);
        field.label = qobject_cast<QLabel*>(rows->labelForField(column));
    }
    if (field.label == nullptr) return;
    field.label->setToolTip(field.tip);
    field.label->setBuddy(field.editor);
    field.label->setWordWrap(true);
    setTextSize(*field.label, TextSize::Body, !parameter.needed.empty());
}

bool FieldForm::hasReference() const {
    return std::any_of(fields_.begin(), fields_.end(), [](const Field& field) { return field.parameter.reference; });
}

Result<ProtocolSettings> FieldForm::read() {
    std::map<std::string, std::string> settings;
    for (const auto& field : fields_) settings[field.parameter.name] = field.text().trimmed().toStdString();
    askForAll();
    auto chosen = applySettings(declaration_, settings);
    if (!chosen) return chosen;
    // A default that was not edited keeps the script's value exactly: its text in the field may be rounded, and would
    // then read as a value that the operator did not choose.
    for (const auto& field : fields_) {
        auto& value = chosen->parameters[field.parameter.name];
        if (field.text() == field.atFirst) value = field.parameter.value;
        if (value == field.parameter.value) chosen->given.erase(field.parameter.name);
    }
    return chosen;
}

const FieldForm::Field* FieldForm::find(const std::string& name) const {
    const auto found = std::ranges::find(fields_, name, [](const Field& field) { return field.parameter.name; });
    return found == fields_.end() ? nullptr : &*found;
}

FieldForm::Field* FieldForm::find(const std::string& name) {
    return const_cast<Field*>(std::as_const(*this).find(name));
}

QString FieldForm::text(const std::string& name) const {
    const auto* field = find(name);
    return field == nullptr ? QString() : field->text().trimmed();
}

void FieldForm::set(const std::string& name, const QString& text) {
    if (const auto* field = find(name)) field->write(text);
}

void FieldForm::propose(const std::string& name, const QString& text) {
    auto* field = find(name);
    if (field == nullptr) return;
    // Noted first: writing makes the form say how many are changed.
    field->proposed = text;
    field->write(text);
    field->proposed = field->text();
}

void FieldForm::setChoices(const std::string& name, const std::vector<std::pair<QString, QString>>& choices) {
    auto* field = find(name);
    auto* box = field == nullptr ? nullptr : qobject_cast<QComboBox*>(field->editor);
    if (box == nullptr) return;
    const QSignalBlocker quiet(box);
    const auto before = field->text();
    field->parameter.choices = utf8(choices);
    for (auto& each : declaration_.parameters)  // read() uses the declaration
        if (each.name == name) each.choices = field->parameter.choices;
    box->clear();
    offer(*box, field->parameter);
    box->setCurrentIndex(std::max(0, box->findData(before)));
    judge();
}

void FieldForm::refuse(const std::string& name, const QString& why) {
    auto* field = find(name);
    if (field == nullptr) return;
    field->why = why;
    say(*field, false);
}

void FieldForm::goTo(const std::string& name) {
    const auto* field = find(name);
    if (field == nullptr) return;
    if (auto* line = qobject_cast<QLineEdit*>(field->editor)) line->selectAll();
    field->editor->setFocus();
}

void FieldForm::setRowVisible(const std::string& name, bool visible) {
    if (const auto* field = find(name)) settingsRows_->setRowVisible(field->row, visible);
}

void FieldForm::setRowVisible(QWidget& own, bool visible) { settingsRows_->setRowVisible(&own, visible); }

bool FieldForm::isRowVisible(QWidget& own) const { return settingsRows_->isRowVisible(&own); }

void FieldForm::setFieldEnabled(const std::string& name, bool enabled) {
    if (const auto* field = find(name))
        for (auto* part : {field->editor, static_cast<QWidget*>(field->label)})
            if (part != nullptr) part->setEnabled(enabled);
}

void FieldForm::setKnown(std::set<std::string> names) {
    if (names == known_) return;
    known_ = std::move(names);
    judge();
}

/// True if the verdict needs an answer and the field is empty or 0.
bool FieldForm::lacks(const Field& field) const {
    if (field.parameter.needed.empty() || known_.contains(field.parameter.name)) return false;
    const auto value = parseSetting(field.parameter, field.text().trimmed().toStdString());
    return value && (*value == 0 || (value->is_string() && value->get_ref<const std::string&>().empty()));
}

std::optional<QString> FieldForm::electrode() const {
    return electrode_ == nullptr ? std::nullopt : electrode_->named();
}

void FieldForm::nameElectrode(const QString& name) {
    if (electrode_ != nullptr) electrode_->setEditText(name);
}

QString FieldForm::unanswered() const {
    for (const auto& field : fields_) {
        if (!lacks(field)) continue;
        return tr("Enter “%1” first.").arg(qtext(field.parameter.label).remove('&'));
    }
    return {};
}

QString FieldForm::refusal() const {
    for (const auto& field : fields_) {
        const auto* rows = field.parameter.reference ? referenceRows_ : settingsRows_;
        const bool asked = rows->isRowVisible(field.row) && field.editor->isEnabledTo(field.row);
        if (field.why.isEmpty() || lacks(field) || !asked) continue;
        const auto label = QString("“%1”").arg(qtext(field.parameter.label).remove('&'));
        const auto said = tr("This");
        return field.why.startsWith(said + ' ') ? label + field.why.mid(said.size()) : label + ": " + field.why;
    }
    return {};
}

QString FieldForm::wrong() const {
    const auto refused = refusal();
    return refused.isEmpty() ? unanswered() : refused;
}

QString FieldForm::summary() const {
    QStringList said;
    int changed = 0;
    for (const auto& field : fields_) {
        if (field.parameter.reference) continue;
        const auto value = parseSetting(field.parameter, field.text().trimmed().toStdString());
        if (!field.parameter.needed.empty() && value && value->is_number() && *value != 0)
            said << settingText(value->get<double>(), QString::fromStdString(field.parameter.unit));
        else if (!field.parameter.needed.empty() && known_.contains(field.parameter.name))
            said << tr("by the profile");
        else if (field.text() != field.proposed)
            ++changed;
    }
    said << (changed == 0 ? tr("defaults") : tr("%1 changed").arg(changed));
    return said.join(" · ");
}

int FieldForm::refused(bool reference) const {
    return int(std::count_if(fields_.begin(), fields_.end(), [reference](const Field& field) {
        return field.parameter.reference == reference && !field.why.isEmpty();
    }));
}

std::optional<bool> FieldForm::goToRefused() {
    askForAll();
    for (const auto& field : fields_) {
        if (field.why.isEmpty()) continue;
        field.editor->setFocus();
        return field.parameter.reference;
    }
    return std::nullopt;
}

void FieldForm::judge() {
    for (auto& field : fields_) {
        const auto value = parseSetting(field.parameter, field.text().trimmed().toStdString());
        const bool lacking = lacks(field);
        field.why = !value    ? refusalText(field.parameter, value.error())
                    : lacking ? tr("Without it %1.").arg(QString::fromStdString(field.parameter.needed))
                              : QString();
        if (auto* line = qobject_cast<QLineEdit*>(field.editor); line != nullptr && !field.parameter.zero.empty())
            line->setPlaceholderText(lacking ? tr("not stated") : QString::fromStdString(field.parameter.zero));
        say(field, lacking);
    }
    emit edited();
}

void FieldForm::say(const Field& field, bool lacking) const {
    const bool said = !field.why.isEmpty() && (!lacking || !missingSaidOnceLeft_ || field.left);
    field.trouble->say(said ? field.why : QString());
}

bool FieldForm::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::MouseButtonRelease) {
        for (const auto& field : fields_)
            if (auto* tick = qobject_cast<QCheckBox*>(field.editor); tick != nullptr && field.label == watched)
                tick->click();
    }
    if (event->type() == QEvent::FocusOut) {
        const auto reason = static_cast<QFocusEvent*>(event)->reason();
        const bool comesBack = reason == Qt::PopupFocusReason || reason == Qt::ActiveWindowFocusReason;
        for (auto& field : fields_) {
            if (field.editor != watched || comesBack) continue;
            field.left = true;
            say(field, lacks(field));
        }
    }
    return QWidget::eventFilter(watched, event);
}

void FieldForm::askForAll() {
    for (auto& field : fields_) {
        field.left = true;
        say(field, lacks(field));
    }
}

}  // namespace tacto::gui

#include "moc_FieldForm.cpp"
