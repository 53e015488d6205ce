#include "app/gui/theme/ElectrodeBox.h"

#include <QSettings>
#include <QSignalBlocker>
#include <cmath>

#include "app/gui/theme/Building.h"
#include "core/base/TypedNumber.h"

namespace tacto::gui {

namespace {

constexpr const char* kAreas = "electrodeAreas";
constexpr const char* kLast = "electrode";
constexpr int kNameLimit = 60, kShownChars = 9;

QVariantMap areas() { return QSettings().value(kAreas).toMap(); }

bool isArea(const QString& text) {
    const auto area = typedNumber(text.trimmed().toStdString());
    return area && std::isfinite(*area) && *area > 0;
}

}  // namespace

ElectrodeBox::ElectrodeBox(QLineEdit& area, QWidget* parent) : QComboBox(parent), area_(area) {
    nameWidget(*this, "electrode", tr("Electrode"),
               tr("Name the electrode: its area is then remembered, and is there again when you choose it."));
    setEditable(true);
    setInsertPolicy(NoInsert);
    setCompleter(nullptr);  // the name of another electrode is never put in its place
    setSizeAdjustPolicy(AdjustToMinimumContentsLengthWithIcon);
    setMinimumContentsLength(kShownChars);
    lineEdit()->setMaxLength(kNameLimit);
    lineEdit()->setPlaceholderText(tr("electrode"));
    list();
    follow();
    connect(this, &QComboBox::activated, this, &ElectrodeBox::name);
    connect(lineEdit(), &QLineEdit::editingFinished, this, &ElectrodeBox::name);
    connect(&area_, &QLineEdit::editingFinished, this, &ElectrodeBox::keep);
    connect(&area_, &QLineEdit::textChanged, this, [this] {
        if (!area_.isModified()) follow();
    });
}

void ElectrodeBox::showPopup() {
    list();
    QComboBox::showPopup();
}

void ElectrodeBox::list() {
    const QSignalBlocker quiet(this);
    const auto shown = currentText();
    clear();
    addItems(areas().keys());
    setCurrentIndex(findText(shown, Qt::MatchFixedString | Qt::MatchCaseSensitive));
    setEditText(shown);
}

/// The electrode was chosen or named.
void ElectrodeBox::name() {
    const auto name = currentText().trimmed();
    if (name.isEmpty()) return;
    const auto known = areas().value(name).toString();
    QSettings().setValue(kLast, name);
    if (known.isEmpty()) return keep();
    if (area_.text().trimmed() != known) area_.setText(known);
    area_.setModified(false);
}

/// Keeps the area with the name, if there are both.
void ElectrodeBox::keep() {
    const auto name = currentText().trimmed(), area = area_.text().trimmed();
    if (name.isEmpty() || !isArea(area)) return;
    auto all = areas();
    all[name] = area;
    QSettings().setValue(kAreas, all);
}

/// An area that the program filled in belongs to the electrode named last, or to none.
void ElectrodeBox::follow() {
    const auto last = QSettings().value(kLast).toString();
    const auto area = area_.text().trimmed();
    const auto known = areas().value(last).toString();
    setEditText(!area.isEmpty() && typedNumber(known.toStdString()) == typedNumber(area.toStdString()) ? last
                                                                                                       : QString());
}

}  // namespace tacto::gui

#include "moc_ElectrodeBox.cpp"
