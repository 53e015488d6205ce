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
    form->setFieldGrowthPolicy(QFormLayout::ExpandingFieldsGrow);
}

ParameterForm::Field ParameterForm::makeField(const ProtocolParameter& parameter, QWidget*& editor) {
    Field field{parameter, {}, nullptr};
    if (parameter.type == ParameterType::Choice) {
        auto* box = new QComboBox(this);
        for (const auto& [key, text] : parameter.choices)
            box->addItem(QString::fromStdString(text.empty() ? key : text), QString::fromStdString(key));
        box->setCurrentIndex(box->findData(plain(parameter.value)));
        box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
        connect(box, &QComboBox::currentIndexChanged, this, &ParameterForm::judge);
        field.text = [box] { return box->currentData().toString(); };
        editor = box;
    } else if (parameter.type == ParameterType::Boolean) {
        auto* box = new QCheckBox(tr("yes"), this);
        box->setChecked(parameter.value.is_boolean() && parameter.value.get<bool>());
        connect(box, &QCheckBox::toggled, this, &ParameterForm::judge);
        field.text = [box] { return box->isChecked() ? QString("true") : QString("false"); };
        editor = box;
    } else {
        auto* line = new QLineEdit(plain(parameter.value), this);
        connect(line, &QLineEdit::textChanged, this, &ParameterForm::judge);
        field.text = [line] { return line->text(); };
        editor = line;
    }
    editor->setObjectName(QString::fromStdString(parameter.name));
    const auto range = rangeText(parameter);
    editor->setToolTip(range.isEmpty() ? QString::fromStdString(parameter.label)
                                       : QString("%1: %2").arg(QString::fromStdString(parameter.label), range));
    return field;
}

void ParameterForm::show(const ProtocolDeclaration& declaration) {
    auto* form = static_cast<QFormLayout*>(layout());
    while (form->rowCount() > 0) form->removeRow(0);
    fields_.clear();
    declaration_ = declaration;
    for (const auto& parameter : declaration.parameters) {
        QWidget* editor = nullptr;
        auto field = makeField(parameter, editor);
        auto* column = new QWidget(this);
        auto* stack = new QVBoxLayout(column);
        stack->setContentsMargins(0, 0, 0, 0);
        stack->setSpacing(1);
        stack->addWidget(editor);
        field.trouble = new QLabel(column);
        field.trouble->setObjectName("trouble-" + QString::fromStdString(parameter.name));
        field.trouble->setWordWrap(true);
        field.trouble->hide();
        stack->addWidget(field.trouble);
        auto label = QString::fromStdString(parameter.label);
        if (!parameter.unit.empty())
            label += QString(" (%1)").arg(settingText(1, QString::fromStdString(parameter.unit)).mid(2));
        form->addRow(label, column);
        if (auto* written = qobject_cast<QLabel*>(form->labelForField(column))) written->setBuddy(editor);
        fields_.push_back(std::move(field));
    }
    judge();
}

Result<ProtocolSettings> ParameterForm::read() {
    std::map<std::string, std::string> settings;
    for (const auto& field : fields_) settings[field.parameter.name] = field.text().trimmed().toStdString();
    return applySettings(declaration_, settings);
}

QString ParameterForm::text(const std::string& name) const {
    for (const auto& field : fields_) {
        if (field.parameter.name == name) return field.text().trimmed();
    }
    return {};
}

void ParameterForm::judge() {
    for (const auto& field : fields_) {
        const auto value = parseSetting(field.parameter, field.text().trimmed().toStdString());
        field.trouble->setText(value ? QString() : QString::fromStdString(value.error().message));
        field.trouble->setVisible(!value);
        auto red = field.trouble->palette();
        red.setColor(QPalette::WindowText, colours().fault);
        field.trouble->setPalette(red);
    }
    emit edited();
}

}  // namespace tacto::gui
