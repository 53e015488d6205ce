#include <gtest/gtest.h>
#include <sqlite3.h>

#include "core/session/Schema.h"

namespace tacto {
namespace {

Database memory() { return Database::open(":memory:", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE).value(); }

TEST(Schema, CarriesItsIds) {
    auto database = memory();
    ASSERT_TRUE(createSchema(database));
    EXPECT_EQ(database.number("PRAGMA application_id").value(), 0x54414354);
    EXPECT_EQ(database.number("PRAGMA user_version").value(), kSchemaVersion);
}

TEST(Schema, MigratesStepByStep) {
    auto database = memory();
    ASSERT_TRUE(database.execute("CREATE TABLE a(x); PRAGMA user_version=1"));
    const Migration steps[] = {{2, "INSERT INTO a(x) VALUES(20)"}, {1, "ALTER TABLE a ADD COLUMN y"}};
    ASSERT_TRUE(migrate(database, steps, 3));
    EXPECT_EQ(database.number("PRAGMA user_version").value(), 3);
    EXPECT_EQ(database.number("SELECT x FROM a WHERE y IS NULL").value(), 20);
    ASSERT_TRUE(migrate(database, steps, 3)) << "nothing to do";
    EXPECT_EQ(database.number("SELECT count(*) FROM a").value(), 1);
}

TEST(Schema, AStepThatFailsLeavesItsVersion) {
    auto database = memory();
    ASSERT_TRUE(database.execute("CREATE TABLE a(x); PRAGMA user_version=1"));
    const Migration steps[] = {{1, "INSERT INTO a VALUES(1); INSERT INTO nowhere VALUES(1)"}};
    EXPECT_FALSE(migrate(database, steps, 2));
    EXPECT_EQ(database.number("PRAGMA user_version").value(), 1);
    EXPECT_EQ(database.number("SELECT count(*) FROM a").value(), 0);
}

TEST(Schema, RefusesNewerAndUnknownVersions) {
    auto database = memory();
    ASSERT_TRUE(database.execute("PRAGMA user_version=7"));
    const auto newer = migrate(database, {}, 3);
    ASSERT_FALSE(newer);
    EXPECT_NE(newer.error().message.find("session format 7, made by a newer"), std::string::npos);
    ASSERT_TRUE(database.execute("PRAGMA user_version=0"));
    EXPECT_FALSE(migrate(database, migrations(), kSchemaVersion));
}

}  // namespace
}  // namespace tacto
