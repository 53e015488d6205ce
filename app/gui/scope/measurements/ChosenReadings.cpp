#include "app/gui/scope/measurements/ChosenReadings.h"

#include <QKeyEvent>
#include <QMenu>
#include <QMouseEvent>
#include <QSettings>
#include <algorithm>

namespace tacto::gui {

namespace {

const std::vector<Reading> kStandard{Reading::Amplitude, Reading::PeakToPeak, Reading::Width,  Reading::Gap,
                                     Reading::Interval,  Reading::Rise,       Reading::Charge, Reading::Imbalance};

/// Choosing one of several does not end the choice.
class StayingMenu final : public QMenu {
public:
    using QMenu::QMenu;

protected:
    void mouseReleaseEvent(QMouseEvent* event) override {
        if (!toggled(actionAt(event->position().toPoint()))) QMenu::mouseReleaseEvent(event);
    }
    void keyPressEvent(QKeyEvent* event) override {
        const bool chooses = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
        if (!chooses || !toggled(activeAction())) QMenu::keyPressEvent(event);
    }

private:
    static bool toggled(QAction* action) {
        if (action == nullptr || !action->isCheckable()) return false;
        action->trigger();
        return true;
    }
};

}  // namespace

ChosenReadings::ChosenReadings() : chosen_(kStandard) {}

bool ChosenReadings::has(Reading reading) const {
    return std::find(chosen_.begin(), chosen_.end(), reading) != chosen_.end();
}

void ChosenReadings::choose(Reading reading, bool on) {
    if (has(reading) == on) return;
    if (on) {
        chosen_.insert(std::upper_bound(chosen_.begin(), chosen_.end(), reading), reading);
    } else {
        std::erase(chosen_, reading);
    }
    emit changed();
}

void ChosenReadings::chooseStandard() {
    if (chosen_ == kStandard) return;
    chosen_ = kStandard;
    emit changed();
}

void ChosenReadings::save(QSettings& settings) const {
    QStringList keys;
    for (const auto reading : chosen_) keys << nameOf(reading).key;
    settings.setValue("readings", keys);
}

void ChosenReadings::restore(const QSettings& settings) {
    std::vector<Reading> restored;
    for (const auto& key : settings.value("readings").toStringList()) {
        const auto reading = readingOfKey(key);
        if (reading && std::find(restored.begin(), restored.end(), *reading) == restored.end()) {
            restored.push_back(*reading);
        }
    }
    std::sort(restored.begin(), restored.end());
    if (restored.empty() || restored == chosen_) return;
    chosen_ = restored;
    emit changed();
}

QMenu* makeReadingsMenu(ChosenReadings& chosen, QWidget* parent) {
    auto* menu = new StayingMenu(parent);
    menu->setToolTipsVisible(true);
    std::vector<QAction*> actions;
    for (const auto reading : allReadings()) {
        const auto name = nameOf(reading);
        auto* action = menu->addAction(name.title);
        action->setToolTip(name.explained);
        action->setCheckable(true);
        action->setChecked(chosen.has(reading));
        QObject::connect(action, &QAction::toggled, &chosen,
                         [&chosen, reading](bool on) { chosen.choose(reading, on); });
        actions.push_back(action);
    }
    QObject::connect(&chosen, &ChosenReadings::changed, menu, [&chosen, actions] {
        for (std::size_t i = 0; i < actions.size(); ++i) actions[i]->setChecked(chosen.has(allReadings()[i]));
    });
    menu->addSeparator();
    menu->addAction(QObject::tr("As at first"), &chosen, &ChosenReadings::chooseStandard);
    menu->addSeparator();
    menu->addAction(QObject::tr("Close"))->setToolTip(QObject::tr("Closes this list. Esc stops the output as well."));
    return menu;
}

}  // namespace tacto::gui

#include "moc_ChosenReadings.cpp"
