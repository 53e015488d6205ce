// Sessions as files and as a workspace: listed, searched, exported, replayed, verified.
#include <QPushButton>
#include <QTableWidget>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/gui/desk/BenchDesk.h"
#include "app/gui/sessions/SessionExport.h"
#include "app/gui/sessions/SessionsWorkspace.h"
#include "core/acquisition/Recording.h"
#include "core/session/SessionReader.h"
#include "tests/gui/Person.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class Recorded : public testing::Test {
protected:
    void SetUp() override {
        gui::LiveOrder order;
        order.uris.push_back(*DeviceUri::parse("sim:"));
        order.profile = desk.profile();
        order.speed = 5;
        desk.openLive(order);
        ASSERT_TRUE(comesTrue([this] { return desk.activity() == gui::Activity::Live; }));
        session = desk.open()->session;
        ASSERT_TRUE(comesTrue([this] { return desk.telemetry().at > std::chrono::seconds(2); }));
        desk.close();
        ASSERT_TRUE(comesTrue([this] { return desk.activity() == gui::Activity::Closed; }));
    }
    void TearDown() override { std::filesystem::remove(session); }
    static gui::WorkPort port(bool cancelled = false) {
        return {std::make_shared<std::atomic<bool>>(cancelled), [](int, int) {}};
    }
    gui::BenchDesk desk{simulatedRegistry};
    std::filesystem::path session;
    const ScratchDir folder;
};

TEST_F(Recorded, IsALineThatSaysWhatItHolds) {
    const auto entry = gui::readEntry(session);
    EXPECT_EQ(entry.problem, "");
    EXPECT_TRUE(entry.simulated);
    EXPECT_TRUE(entry.closed);
    EXPECT_GT(entry.duration_s, 1.5);
    EXPECT_TRUE(entry.searched().contains("simulated stimulator"));
}

TEST_F(Recorded, AForeignFileIsListedWithItsReason) {
    const auto entry = gui::readEntry(folder.write("notes.tacto", "no session of any kind"));
    EXPECT_NE(entry.problem, "");
}

TEST_F(Recorded, ExportsEverySampleAsItWasRecorded) {
    const auto target = folder.path() / "csv";
    ASSERT_TRUE(gui::exportCsv(session, target, port()));
    const auto reader = SessionReader::open(session);
    ASSERT_TRUE(reader);
    const auto streams = reader->streams();
    ASSERT_TRUE(streams && !streams->empty());
    const auto& info = streams->front();
    const auto samples = reader->samples(info.id);
    ASSERT_TRUE(samples);
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator(target)) {
        if (entry.path().filename().string().starts_with("stream-1-")) found.push_back(entry.path());
    }
    ASSERT_EQ(found.size(), 1U);
    std::ifstream csv(found.front());
    std::string line;
    ASSERT_TRUE(std::getline(csv, line));
    EXPECT_TRUE(line.starts_with("time_s,"));
    std::size_t rows = 0;
    const auto columns = info.stream.columns.size();
    while (std::getline(csv, line)) {
        ASSERT_LT(rows, samples->samples());
        const auto cells = QString::fromStdString(line).split(',');
        ASSERT_EQ(std::size_t(cells.size()), columns + 1);
        EXPECT_EQ(cells[0].toDouble(), samples->t_s[rows]);
        for (std::size_t c = 0; c < columns; ++c)
            EXPECT_EQ(cells[int(c) + 1].toDouble(), samples->values[rows * columns + c]);
        ++rows;
    }
    EXPECT_EQ(rows, samples->samples());
}

TEST_F(Recorded, ACancelledExportLeavesNothing) {
    const auto target = folder.path() / "csv";
    EXPECT_EQ(gui::exportCsv(session, target, port(true)).error().code, ErrorCode::Stopped);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST_F(Recorded, AnExportWritesOverNothing) {
    const auto error = gui::exportCsv(session, folder.path(), port());
    ASSERT_FALSE(error);
    EXPECT_THAT(error.error().message, HasSubstr("is there already"));
}

TEST_F(Recorded, ReplaysAsARecording) {
    const auto target = folder.path() / "again";
    const auto written = gui::exportRecording(session, target, port());
    ASSERT_TRUE(written) << written.error().message;
    const auto recording = Recording::open(target);
    ASSERT_TRUE(recording) << recording.error().message;
    EXPECT_EQ(recording->streams.size(), 3U);
}

TEST_F(Recorded, IsFoundVerifiedAndSearchedInTheWorkspace) {
    gui::SessionsWorkspace workspace(desk);
    workspace.resize(1200, 700);
    workspace.show();
    auto* table = workspace.findChild<QTableWidget*>("sessionsTable");
    ASSERT_NE(table, nullptr);
    ASSERT_TRUE(workspace.openSession(QString::fromStdString(session.string())));
    ASSERT_TRUE(comesTrue([&] { return table->rowCount() >= 1 && !table->selectedItems().isEmpty(); }));
    auto* verify = find<QPushButton>(workspace, "Verify");
    ASSERT_NE(verify, nullptr);
    ASSERT_TRUE(comesTrue([&] { return verify->isEnabled(); }));
    click(*verify);
    auto* says = workspace.findChild<QLabel*>("sessionsSay");
    EXPECT_TRUE(comesTrue([&] { return says->text().contains("is intact"); })) << says->text().toStdString();
    shot(workspace, "sessions");
    auto* search = find<QLineEdit>(workspace, "Search");
    search->setText("no-such-word");
    EXPECT_TRUE(table->isRowHidden(0));
    search->clear();
    EXPECT_FALSE(table->isRowHidden(0));
}

}  // namespace
}  // namespace tacto::test
