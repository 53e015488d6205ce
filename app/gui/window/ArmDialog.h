// ArmDialog.h - the second step of arming, and of checking the impedance: what will be connected, what the limits will
// be held against, the text that the operator confirms, and a button that is not the default one (hazards H6, H12). It
// closes when a stop comes and after 30 s.
#pragma once

#include <QCheckBox>
#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QObject>
#include <QPushButton>
#include <QVBoxLayout>
#include <filesystem>

#include "app/gui/controller/BenchController.h"

namespace tacto::gui {

class ArmDialog final : public QDialog {
    Q_OBJECT
public:
    enum class Purpose { Arm, CheckImpedance };
    ArmDialog(BenchController& controller, Purpose purpose, const QString& load, QWidget* parent);
    /// The declared load, as written.
    [[nodiscard]] QString load() const { return load_->text(); }

private:
    void addPurpose(QVBoxLayout& layout);
    void addLoad(QVBoxLayout& layout, const QString& load);
    void addWhatIsArmed(QVBoxLayout& layout);
    QPushButton* addButtons(QVBoxLayout& layout);
    void judge();
    void confirm();
    void sayFirst();

    BenchController& controller_;
    const Purpose purpose_;
    const StopMark asked_;  // when the operator took the first step
    std::string text_;      // the text of confirmed_
    QLineEdit* load_;
    QLabel* confirmed_;
    QLabel* first_;  ///< the first output once it is armed
    QLabel* trouble_;
    QCheckBox* connected_;
    QPushButton* arm_;
    bool readsBack_ = true;
    bool massager_ = false;  // has no load
};

/// Asks before the bench that is open is armed or its impedance is checked, and keeps the load that was
/// declared last for the next time.
class ArmQuestion final : public QObject {
    Q_OBJECT
public:
    ArmQuestion(BenchController& controller, QWidget& window);
    /// The first of the two steps. With another bench or profile the question is void.
    void ask(ArmDialog::Purpose purpose);

signals:
    /// There is nothing to arm or to check: a sentence with what to do.
    void refused(const QString& why);

private:
    void noteBench();

    BenchController& controller_;
    QWidget& window_;
    QString load_;                  ///< declared last, or known of a simulated bench
    std::filesystem::path loadOf_;  ///< the session of its bench
};

}  // namespace tacto::gui
