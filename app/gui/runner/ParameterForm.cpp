#include "app/gui/runner/ParameterForm.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFocusEvent>
#include <QLineEdit>
#include <QToolButton>
#include <QVBoxLayout>

#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/EntryFields.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "core/base/JsonText.h"

namespace tacto::gui {

namespace {

constexpr int kLabelWidth = 280;  // before a label wraps

QString shownUnit(const ProtocolParameter& parameter) {
    return axisUnit(0, QString::fromStdString(parameter.unit)).unit;
}

/// In the unit that stands behind the label, as what is typed is: "0.5 to 10", never "500 ms to 10 s".
QString rangeText(const ProtocolParameter& parameter) {
    const auto text = [](double value) { return grouped(settingText(value, {})); };
    if (parameter.min && parameter.max) return QObject::tr("%1 to %2").arg(text(*parameter.min), text(*parameter.max));
    if (parameter.min) return QObject::tr("at least %1").arg(text(*parameter.min));
    if (parameter.max) return QObject::tr("at most %1").arg(text(*parameter.max));
    return {};
}

/// What a script calls "load" has a label on the screen.
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

/// As a field shows it: empty where 0 stands for something.
QString shown(const ProtocolParameter& parameter, const nlohmann::json& value) {
    return !parameter.zero.empty() && value == 0 ? QString() : plain(value);
}

QFormLayout* rowsIn(QWidget& part) {
    auto* form = new QFormLayout(&part);
    form->setContentsMargins(0, 0, 0, 0);
    form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    form->setRowWrapPolicy(QFormLayout::WrapAllRows);  // a narrow column: nothing is cut
    return form;
}

}  // namespace

ParameterForm::ParameterForm(QWidget* parent)
    : QWidget(parent),
      settingsRows_(rowsIn(*this)),
      reference_(new QWidget(parent)),
      referenceRows_(rowsIn(*reference_)) {
    onFontChange(*this, [this] { fitLabels(); });
}

/// A label wraps where it is long, and not between two short words. Fields with a range end where the widest range
/// begins.
void ParameterForm::fitLabels() {
    int widest = 0;
    for (const auto& field : fields_) {
        field.range->ensurePolished();
        field.range->setVisible(!field.range->text().isEmpty());
        if (!field.range->text().isEmpty()) widest = std::max(widest, field.range->sizeHint().width());
        if (field.label == nullptr) continue;
        field.label->setMinimumWidth(
            std::min(scaledPx(kLabelWidth), 2 * fontMetrics().averageCharWidth() * int(field.label->text().size())));
    }
    for (const auto& field : fields_) {
        field.range->setMinimumWidth(widest);
    }
}

ParameterForm::Field ParameterForm::makeField(const ProtocolParameter& parameter) {
    Field field{parameter, {}, {}};
    if (parameter.type == ParameterType::Choice) {
        auto* box = new QComboBox(this);
        for (const auto& [key, text] : parameter.choices)
            box->addItem(withOhmSigns(qtext(text.empty() ? key : text)), qtext(key));
        box->setCurrentIndex(box->findData(plain(parameter.value)));
        box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
        box->setMinimumContentsLength(8);  // characters; grows with the column
        box->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
        connect(box, &QComboBox::currentIndexChanged, this, &ParameterForm::judge);
        field.text = [box] { return box->currentData().toString(); };
        field.write = [box](const QString& key) {
            if (const int index = box->findData(key); index >= 0) box->setCurrentIndex(index);
        };
        field.editor = box;
    } else if (parameter.type == ParameterType::Boolean) {
        auto* box = new QCheckBox(this);
        box->setChecked(parameter.value.is_boolean() && parameter.value.get<bool>());
        connect(box, &QCheckBox::toggled, this, &ParameterForm::judge);
        field.text = [box] { return box->isChecked() ? QString("true") : QString("false"); };
        field.write = [box](const QString& word) { box->setChecked(word == "true"); };
        field.editor = box;
    } else {
        addLine(field);
    }
    if (field.whole == nullptr) field.whole = field.editor;
    field.editor->setObjectName(QString::fromStdString(parameter.name));
    field.editor->installEventFilter(this);
    const auto range = rangeText(parameter);
    const auto label = QString::fromStdString(parameter.label);
    field.editor->setAccessibleName(label);
    const auto takes = range.isEmpty()          ? QString()
                       : parameter.unit.empty() ? tr(" and takes %1").arg(range)
                                                : tr(" and takes %1 %2").arg(range, shownUnit(parameter));
    auto tip = tr("%1. The script calls it \"%2\"%3.").arg(label, QString::fromStdString(parameter.name), takes);
    if (!parameter.zero.empty()) tip += tr(" 0, or nothing: %1.").arg(QString::fromStdString(parameter.zero));
    field.editor->setToolTip(tip);
    return field;
}

void ParameterForm::addLine(Field& field) {
    QLineEdit* line = nullptr;
    if (field.parameter.type == ParameterType::Date) {
        auto* day = new DayField(QString::fromStdString(field.parameter.name), tr("not stated"), this);
        field.whole = day;
        line = &day->line();
    } else {
        line = new QLineEdit(this);
    }
    line->setText(shown(field.parameter, field.parameter.value));
    connect(line, &QLineEdit::textChanged, this, &ParameterForm::judge);
    field.text = [line, zero = !field.parameter.zero.empty()] {
        return zero && line->text().trimmed().isEmpty() ? QString("0") : line->text();
    };
    field.write = [line](const QString& text) { line->setText(text); };
    field.editor = line;
    if (field.parameter.type == ParameterType::File) addFileChooser(field);
}

void ParameterForm::addFileChooser(Field& field) {
    auto* line = static_cast<QLineEdit*>(field.editor);
    line->setPlaceholderText(tr("no file"));
    line->setClearButtonEnabled(true);
    auto* button = new QToolButton(this);
    button->setText("…");
    button->setObjectName("choose-" + QString::fromStdString(field.parameter.name));
    button->setAccessibleName(tr("Choose the file"));
    button->setToolTip(tr("Chooses a file."));
    const auto title = QString::fromStdString(field.parameter.label);
    connect(button, &QToolButton::clicked, this, [this, line, title] {
        FileQuestion question;
        question.title = title;
        askForFile(*this, question, [line](const QString& path) { line->setText(path); });
    });
    field.whole = new QWidget(this);
    placeInLine(*field.whole, *line, *button);
}

void ParameterForm::show(const ProtocolDeclaration& declaration) {
    fields_.clear();
    for (auto* rows : {settingsRows_, referenceRows_}) {
        while (rows->rowCount() > 0) rows->removeRow(0);
    }
    declaration_ = declaration;
    for (const bool decisive : {true, false}) {
        for (const auto& parameter : declaration.parameters) {
            if (parameter.needed.empty() == decisive) continue;
            auto field = makeField(parameter);
            field.atFirst = field.text();
            addRow(field);
            fields_.push_back(std::move(field));
        }
    }
    if (settingsRows_->rowCount() == 0) {
        auto* none = new QLabel(tr("This protocol has nothing to set."), this);
        setTone(*none, Tone::Quiet);
        none->setWordWrap(true);
        settingsRows_->addRow(none);
    }
    for (auto* part : {static_cast<QWidget*>(this), reference_}) tabInPlace(*part);
    fitLabels();
    judge();
}

void ParameterForm::addRow(Field& field) {
    const auto& parameter = field.parameter;
    auto* column = new QWidget(this);
    auto* stack = new QVBoxLayout(column);
    stack->setContentsMargins(0, 0, 0, 0);
    stack->setSpacing(0);
    auto* line = new QHBoxLayout;
    const bool ticks = parameter.type == ParameterType::Boolean;
    line->addWidget(field.whole, ticks ? 0 : 1);
    if (ticks) line->addWidget(field.label = new QLabel(qtext(parameter.label), column), 1);
    field.range = new QLabel(rangeText(parameter), column);
    field.range->setTextFormat(Qt::PlainText);
    setTone(*field.range, Tone::Quiet);
    line->setSpacing(fontMetrics().averageCharWidth());
    line->addWidget(field.range);
    stack->addLayout(line);
    field.trouble = new TroubleLine("trouble-" + QString::fromStdString(parameter.name), column);
    stack->addWidget(field.trouble);
    auto label = QString::fromStdString(parameter.label);
    if (!parameter.unit.empty()) label += QString(" (%1)").arg(shownUnit(parameter));
    auto* rows = parameter.reference ? referenceRows_ : settingsRows_;
    if (ticks) {
        rows->addRow(column);
        field.label->installEventFilter(this);  // its click ticks the box; a box's own words would not wrap
    } else {
        rows->addRow(label, column);
        field.label = qobject_cast<QLabel*>(rows->labelForField(column));
    }
    if (field.label == nullptr) return;
    field.label->setBuddy(field.editor);
    field.label->setWordWrap(true);
    setTextSize(*field.label, TextSize::Body, !parameter.needed.empty());
}

bool ParameterForm::hasReference() const {
    return std::any_of(fields_.begin(), fields_.end(), [](const Field& field) { return field.parameter.reference; });
}

Result<ProtocolSettings> ParameterForm::read() {
    std::map<std::string, std::string> settings;
    for (const auto& field : fields_) settings[field.parameter.name] = field.text().trimmed().toStdString();
    askForAll();
    auto applied = applySettings(declaration_, settings);
    if (!applied) return applied;
    // A default that was left as it is stays the script's word, to the last digit and blank: what a field shows of it
    // may read as another value, which the operator did not choose.
    for (const auto& field : fields_) {
        auto& value = applied->parameters[field.parameter.name];
        if (field.text() == field.atFirst) value = field.parameter.value;
        if (value == field.parameter.value) applied->given.erase(field.parameter.name);
    }
    return applied;
}

QString ParameterForm::text(const std::string& name) const {
    for (const auto& field : fields_) {
        if (field.parameter.name == name) return field.text().trimmed();
    }
    return {};
}

void ParameterForm::set(const std::string& name, const QString& text) {
    for (const auto& field : fields_) {
        if (field.parameter.name == name) field.write(text);
    }
}

void ParameterForm::setKnown(std::set<std::string> names) {
    if (names == known_) return;
    known_ = std::move(names);
    judge();
}

/// Neither 0 nor an empty field answers what the verdict needs.
bool ParameterForm::lacks(const Field& field) const {
    if (field.parameter.needed.empty() || known_.contains(field.parameter.name)) return false;
    const auto value = parseSetting(field.parameter, field.text().trimmed().toStdString());
    return value && (*value == 0 || (value->is_string() && value->get_ref<const std::string&>().empty()));
}

QString ParameterForm::unanswered() const {
    for (const auto& field : fields_) {
        if (!lacks(field)) continue;
        return tr("Enter “%1” first.").arg(qtext(field.parameter.label));
    }
    return {};
}

QString ParameterForm::summary() const {
    QStringList said;
    int changed = 0;
    for (const auto& field : fields_) {
        if (field.parameter.reference) continue;
        const auto value = parseSetting(field.parameter, field.text().trimmed().toStdString());
        if (!field.parameter.needed.empty() && value && value->is_number() && *value != 0)
            said << settingText(value->get<double>(), QString::fromStdString(field.parameter.unit));
        else if (!field.parameter.needed.empty() && known_.contains(field.parameter.name))
            said << tr("by the profile");
        else if (field.text() != field.atFirst)
            ++changed;
    }
    said << (changed == 0 ? tr("defaults") : tr("%1 changed").arg(changed));
    return said.join(" · ");
}

int ParameterForm::refused(bool reference) const {
    return int(std::count_if(fields_.begin(), fields_.end(), [reference](const Field& field) {
        return field.parameter.reference == reference && !field.why.isEmpty();
    }));
}

std::optional<bool> ParameterForm::goToRefused() {
    askForAll();
    for (const auto& field : fields_) {
        if (field.why.isEmpty()) continue;
        field.editor->setFocus();
        return field.parameter.reference;
    }
    return std::nullopt;
}

void ParameterForm::judge() {
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

void ParameterForm::say(const Field& field, bool lacking) const {
    const bool said = !field.why.isEmpty() && (!lacking || !missingSaidOnceLeft_ || field.left);
    field.trouble->say(said ? field.why : QString());
}

bool ParameterForm::eventFilter(QObject* watched, QEvent* event) {
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

void ParameterForm::askForAll() {
    for (auto& field : fields_) {
        field.left = true;
        say(field, lacks(field));
    }
}

}  // namespace tacto::gui

#include "moc_ParameterForm.cpp"
