// ArmDialog.h - the second step of arming or of checking the impedance. Shows what will be connected, the limits that
// apply, and the text that the operator confirms; its button is not the default one (hazards H6, H12). Closes after a
// stop, or after 30 s.
#pragma once

#include <QCheckBox>
#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QObject>
#include <QPushButton>
#include <QVBoxLayout>
#include <filesystem>
#include <optional>

#include "app/gui/controller/BenchController.h"
#include "core/encoding/Encoder.h"

namespace tacto::gui {

class ArmDialog final : public QDialog {
    Q_OBJECT
public:
    enum class Purpose { Arm, CheckImpedance };
    /// `again`: what drove before a fault; unless it is Off, a second button arms and lets it drive again.
    ArmDialog(BenchController& controller, Purpose purpose, const QString& load, const DriveCommand& again,
              QWidget* parent);
    /// The load that the operator declared, as typed.
    [[nodiscard]] QString load() const { return load_->text(); }

private:
    void addPurpose(QVBoxLayout& layout);
    void addLoad(QVBoxLayout& layout, const QString& load);
    void addWhatIsArmed(QVBoxLayout& layout);
    QPushButton* addButtons(QVBoxLayout& layout);
    QPushButton* addConfirm(const QString& text, const char* name, const QString& tip, const DriveCommand& drives);
    void judge();
    void confirm(const DriveCommand& drives);
    void sayFirst();
    [[nodiscard]] QString firstWords(DriveSource source, const std::optional<Command>& first) const;

    BenchController& controller_;
    const Purpose purpose_;
    const StopMark asked_;  // when the operator took the first step
    std::string text_;      // the text shown in confirmed_
    QLineEdit* load_;
    QLabel* confirmed_;
    QLabel* first_;  ///< says what the first output after arming will be
    QLabel* trouble_;
    QCheckBox* connected_;
    QPushButton* arm_;
    QPushButton* again_ = nullptr;
    const DriveCommand before_;
    bool readsBack_ = true;
    bool massager_ = false;  // massagers have no load
};

/// Asks the operator before the open bench is armed or its impedance is checked. Keeps the last declared load for the
/// next question.
class ArmQuestion final : public QObject {
    Q_OBJECT
public:
    ArmQuestion(BenchController& controller, QWidget& window);
    /// Asks, as the first of the two steps. Another bench or profile makes the question void.
    /// `again`: as for ArmDialog.
    void ask(ArmDialog::Purpose purpose, const DriveCommand& again = {});

signals:
    /// Nothing can be armed or checked. `why` is a sentence that says what to do.
    void refused(const QString& why);

private:
    void noteBench();

    BenchController& controller_;
    QWidget& window_;
    QString load_;                  ///< the load declared last, or the known load of a simulated bench
    std::filesystem::path loadOf_;  ///< the session of the bench with this load
};

}  // namespace tacto::gui
