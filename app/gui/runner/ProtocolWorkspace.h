// ProtocolWorkspace.h - runs a protocol: settings and worst case before, points and log while, verdict and report
// after.
//
// With a name it is that protocol's workspace; without one the operator chooses among all of them.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QLineEdit>
#include <QPdfDocument>
#include <QPdfView>
#include <QPlainTextEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QSpinBox>
#include <QTabWidget>
#include <QTimer>

#include "app/gui/desk/BenchDesk.h"
#include "app/scripting/ProtocolLibrary.h"

namespace tacto::gui {

class CaptureStrip;
class ExposureTable;
class ParameterForm;
class PromptPanel;
class ResultPanel;
class ScriptEditor;
class StepList;
class TrialPlane;

class ProtocolWorkspace final : public QWidget {
    Q_OBJECT
public:
    ProtocolWorkspace(BenchDesk& desk, const QString& protocol, QWidget* parent = nullptr);
    void refresh(const Telemetry& telemetry);
    [[nodiscard]] bool running() const { return running_; }

private:
    [[nodiscard]] QWidget* buildSettings();
    [[nodiscard]] QWidget* buildDevices(QWidget* parent);
    [[nodiscard]] QWidget* buildRun();
    [[nodiscard]] QWidget* buildTabs();
    void fillChooser(const QString& select);
    void choose(const QString& nameOrPath);
    void preview();
    void say(const QString& what);
    void run();
    void ended(const FinishedRun& run);
    void showButtons();
    void edit(int line, const QString& why);
    void openReport(const QString& pdf);
    [[nodiscard]] Result<RunOrder> order();

    BenchDesk& desk_;
    const QString fixed_;  ///< the one protocol, or empty
    ProtocolSource source_;
    std::optional<ProtocolDeclaration> declaration_;
    bool running_ = false;
    bool paused_ = false;
    QElapsedTimer since_;
    QString session_;

    StepList* steps_ = nullptr;
    QComboBox* chooser_ = nullptr;
    QLabel* purpose_ = nullptr;
    QLabel* wiring_ = nullptr;
    ParameterForm* form_ = nullptr;
    QLineEdit* devices_ = nullptr;
    QSpinBox* seed_ = nullptr;
    QCheckBox* realtime_ = nullptr;
    QLineEdit* out_ = nullptr;
    QLabel* trouble_ = nullptr;
    QPushButton* run_ = nullptr;
    QPushButton* pause_ = nullptr;
    QPushButton* stop_ = nullptr;
    QProgressBar* progress_ = nullptr;
    QLabel* left_ = nullptr;
    PromptPanel* prompt_ = nullptr;
    TrialPlane* plane_ = nullptr;
    CaptureStrip* wave_ = nullptr;
    QTabWidget* tabs_ = nullptr;
    ExposureTable* worst_ = nullptr;
    QLabel* worstSays_ = nullptr;
    QPlainTextEdit* log_ = nullptr;
    ResultPanel* result_ = nullptr;
    QPdfDocument* document_ = nullptr;
    QPdfView* pdf_ = nullptr;
    ScriptEditor* editor_ = nullptr;
    QTimer previewLater_;
};

}  // namespace tacto::gui
