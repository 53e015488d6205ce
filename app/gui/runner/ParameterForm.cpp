#include "app/gui/runner/ParameterForm.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QVBoxLayout>

#include "app/gui/look/Look.h"

namespace tacto::gui {

namespace {

QString rangeText(const ProtocolParameter& parameter) {
    const auto unit = QString::fromStdString(parameter.unit);
    if (parameter.min && parameter.max)
        return QObject::tr("%1 to %2").arg(settingText(*parameter.min, unit), settingText(*parameter.max, unit));
    if (parameter.min) return QObject::tr("at least %1").arg(settingText(*parameter.min, unit));
    if (parameter.max) return QObject::tr("at most %1").arg(settingText(*parameter.max, unit));
    return {};
}

QString plain(const nlohmann::json& value) {
    if (value.is_string()) return QString::fromStdString(value.get<std::string>());
    if (value.is_number()) return QString::number(value.get<double>(), 'g', 10);
    return QString::fromStdString(value.dump());
}

}  // namespace

ParameterForm::ParameterForm(QWidget* parent) : QWidget(parent) {
    auto* form = new QFormLayout(this);
    form->setContentsMargins(0, 0, 0, 0);
    form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    form->setRowWrapPolicy(QFormLayout::WrapAllRows);  // a narrow column: nothing is cut
}

ParameterForm::Field ParameterForm::makeField(const ProtocolParameter& parameter) {
    Field field{parameter, {}, {}, nullptr, nullptr};
    if (parameter.type == ParameterType::Choice) {
        auto* box = new QComboBox(this);
        for (const auto& [key, text] : parameter.choices)
            box->addItem(QString::fromStdString(text.empty() ? key : text), QString::fromStdString(key));
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
        auto* box = new QCheckBox(tr("yes"), this);
        box->setChecked(parameter.value.is_boolean() && parameter.value.get<bool>());
        connect(box, &QCheckBox::toggled, this, &ParameterForm::judge);
        field.text = [box] { return box->isChecked() ? QString("true") : QString("false"); };
        field.write = [box](const QString& word) { box->setChecked(word == "true"); };
        field.editor = box;
    } else {
        auto* line = new QLineEdit(plain(parameter.value), this);
        connect(line, &QLineEdit::textChanged, this, &ParameterForm::judge);
        field.text = [line] { return line->text(); };
        field.write = [line](const QString& text) { line->setText(text); };
        field.editor = line;
    }
    field.editor->setObjectName(QString::fromStdString(parameter.name));
    const auto range = rangeText(parameter);
    const auto label = QString::fromStdString(parameter.label);
    field.editor->setAccessibleName(label);
    field.editor->setToolTip(tr("%1. The script calls it \"%2\"%3.")
                                 .arg(label, QString::fromStdString(parameter.name),
                                      range.isEmpty() ? QString() : tr(" and takes %1").arg(range)));
    return field;
}

void ParameterForm::show(const ProtocolDeclaration& declaration) {
    auto* form = static_cast<QFormLayout*>(layout());
    while (form->rowCount() > 0) form->removeRow(0);
    fields_.clear();
    declaration_ = declaration;
    for (const auto& parameter : declaration.parameters) {
        auto field = makeField(parameter);
        auto* column = new QWidget(this);
        auto* stack = new QVBoxLayout(column);
        stack->setContentsMargins(0, 0, 0, 0);
        stack->setSpacing(1);
        auto* line = new QHBoxLayout;
        line->addWidget(field.editor, 1);
        if (const auto range = rangeText(parameter); !range.isEmpty()) {
            auto* quiet = new QLabel(range, column);
            quiet->setTextFormat(Qt::PlainText);
            quiet->setForegroundRole(QPalette::PlaceholderText);
            line->addSpacing(fontMetrics().averageCharWidth());
            line->addWidget(quiet);
        }
        stack->addLayout(line);
        field.trouble = new QLabel(column);
        field.trouble->setTextFormat(Qt::PlainText);
        field.trouble->setObjectName("trouble-" + QString::fromStdString(parameter.name));
        field.trouble->setWordWrap(true);
        field.trouble->hide();
        stack->addWidget(field.trouble);
        auto label = QString::fromStdString(parameter.label);
        if (!parameter.unit.empty())
            label += QString(" (%1)").arg(axisUnit(0, QString::fromStdString(parameter.unit)).unit);
        form->addRow(label, column);
        if (auto* written = qobject_cast<QLabel*>(form->labelForField(column))) {
            written->setBuddy(field.editor);
            written->setWordWrap(true);
        }
        fields_.push_back(std::move(field));
    }
    if (fields_.empty()) {
        auto* none = new QLabel(tr("This protocol has nothing to set."), this);
        none->setForegroundRole(QPalette::PlaceholderText);
        none->setWordWrap(true);
        form->addRow(none);
    }
    judge();
}

Result<ProtocolSettings> ParameterForm::read() {
    std::map<std::string, std::string> settings;
    for (const auto& field : fields_) settings[field.parameter.name] = field.text().trimmed().toStdString();
    auto applied = applySettings(declaration_, settings);
    if (!applied) return applied;
    // A default that was left as it is stays the script's word.
    for (const auto& field : fields_) {
        if (applied->parameters[field.parameter.name] == field.parameter.value)
            applied->given.erase(field.parameter.name);
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

void ParameterForm::goToRefused() {
    for (const auto& field : fields_) {
        if (!field.trouble->isHidden()) return field.editor->setFocus();
    }
}

void ParameterForm::judge() {
    refused_ = 0;
    for (const auto& field : fields_) {
        const auto value = parseSetting(field.parameter, field.text().trimmed().toStdString());
        field.trouble->setText(value ? QString() : "⚠ " + QString::fromStdString(value.error().message));
        field.trouble->setVisible(!value);
        if (!value) ++refused_;
    }
    emit edited();
}

}  // namespace tacto::gui
