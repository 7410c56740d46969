//! What a layer says of its columns.

use super::*;

#[test]
fn settings_conditions_and_order_by_column_arrive_where_they_belong() {
    let scene = parse(EVERY_KEY[4]).unwrap();
    let land = &scene.layers[0];
    let fill = land.style.fill.as_ref().unwrap();
    let StyleSetting::ByColumn(by) = &fill.paint.color else { panic!("constant") };
    let Scale::Map(entries) = &by.scale else { panic!("no map") };
    let keys: Vec<&str> = entries.iter().map(|(key, _)| key.as_str()).collect();
    assert_eq!((by.column.as_str(), keys), ("CLASS", vec!["2.50", "wood"]));
    assert_eq!(by.default, Some(Color::from_rgba8([128, 128, 128, 255])));
    let stops = Scale::Stops(vec![(0.0, 0.5), (10.5, 1.0)]);
    let depth = ByColumn { column: "depth".into(), scale: stops, default: None };
    assert_eq!(fill.paint.opacity, StyleSetting::ByColumn(depth));
    assert_eq!(land.columns(), ["CLASS", "a", "depth", "is wet", "lanes", "name"]);
    let columns: Vec<&str> = land.conditions.iter().map(|condition| condition.column.as_str()).collect();
    assert_eq!(columns, ["CLASS", "depth", "is wet", "lanes", "name"]);
    let text = |text: &str| Attribute::Text(text.into());
    let classes = vec![text("wood"), text("meadow"), Attribute::Integer(3)];
    assert_eq!(land.conditions[0].test, Test::OneOf(classes));
    let lanes = Bounds { above: Some(1.0), below: Some(4.5), ..Bounds::default() };
    assert_eq!(land.conditions[3].test, Test::Within(lanes));
    assert_eq!(land.order, Order::By { key: OrderKey::Column("depth".into()), descending: true });
    assert_eq!(scene.layers[1].order, Order::Size);
    let LayerSource::Inline(features) = &land.source else { panic!("not inline") };
    let properties =
        [("", Attribute::Number(0.5)), ("CLASS", text("wood")), ("depth", Attribute::Integer(2))];
    let properties = properties.map(|(name, value)| (name.to_owned(), value));
    assert_eq!(features[0].properties[..3], properties);
    assert_eq!(features[0].properties[3], ("is wet".into(), Attribute::Boolean(true)));
}

#[test]
fn settings_conditions_and_order_by_column_are_checked() {
    for (lines, said) in [
        ("fill = { color = { map = { a = \"#000000\" } } }", "5:18: `layer.0.fill.color.by` is missing"),
        ("fill = { color = { by = \"A\" } }", "`layer.0.fill.color` needs `map` or `stops`"),
        (
            "fill = { color = { by = \"A\", map = {}, stops = [[0, \"#000000\"]] } }",
            "`layer.0.fill.color.map` and `stops` exclude each other",
        ),
        (
            "fill = { color = { by = \"A\", map = { wood = \"gren\" } } }",
            "5:45: `layer.0.fill.color.map.wood` must be a colour of CSS (\"#rrggbb\", \"#rrggbbaa\", \"#rgb\", a name, rgb(), hsl()); found the string \"gren\"\n  help: did you mean \"green\"?",
        ),
        (
            "fill = { color = 3 }",
            "must be a colour of CSS (\"#rrggbb\", \"#rrggbbaa\", \"#rgb\", a name, rgb(), hsl()); found 3",
        ),
        (
            "fill = { color = { by = \"A\", stops = [] } }",
            "`layer.0.fill.color.stops` must be a list of pairs [number, a colour",
        ),
        (
            "fill = { color = { by = \"A\", stops = [[0, \"#000000\"], [1]] } }",
            "`layer.0.fill.color.stops.1` must be a pair [number, a colour",
        ),
        (
            "fill = { color = { by = \"A\", stops = [[1, \"#000000\"], [1, \"#ffffff\"]] } }",
            "`stops` must ascend; 1 is followed by 1",
        ),
        (
            "line = { color = \"#000000\", width_m = { by = \"A\", stops = [[0, 1], [1, 0]] } }",
            "`layer.0.line.width_m.stops.1.1` must be a finite number greater than 0; found 0",
        ),
        (
            "line = { color = \"#000000\", width_m = 1, opacity = { by = \"A\", map = { a = 2 } } }",
            "`layer.0.line.opacity.map.a` must be a number from 0 to 1; found 2",
        ),
        (
            "fill = { color = \"#000000\" }\nwhere = { A = [] }",
            "6:15: `layer.0.where.A` must be a string, a finite number, true or false, or a list of these; found an array of 0",
        ),
        ("fill = { color = \"#000000\" }\nwhere = { A = [1, [2]] }", "`layer.0.where.A.1` must be a string"),
        (
            "fill = { color = \"#000000\" }\nwhere = { A = { mni = 1 } }",
            "there is no key `layer.0.where.A.mni`\n  help: did you mean `min`?",
        ),
        ("fill = { color = \"#000000\" }\nwhere = { A = { min = 1, above = 0 } }", "exclude each other"),
        ("fill = { color = \"#000000\" }\nwhere = { A = {} }", "`layer.0.where.A` needs `min` or `max`"),
        ("fill = { color = \"#000000\" }\norder = \"sise\"", "help: did you mean \"size\"?"),
        ("fill = { color = \"#000000\" }\norder = { descending = true }", "`layer.0.order.by` is missing"),
        (
            "fill = { color = \"#000000\" }\norder = { by = \"A\", descending = \"yes\" }",
            "`layer.0.order.descending` must be true or false; found the string \"yes\"",
        ),
        (
            "fill = { color = { by = \"A\", map = { 2.5 = \"#000000\" } } }",
            "5:38: `layer.0.fill.color.map`: 2.5 without quotes is a key `5` in a table `2`\n  help: put it in quotes: \"2.5\"",
        ),
    ] {
        let error = layer(lines);
        assert!(error.contains(said), "{lines}\n{error}");
    }
}

#[test]
fn overrides_reach_into_settings_by_column() {
    let scene = with(
        EVERY_KEY[4],
        &[
            "layer.land.order=size",
            "layer.land.fill.color.map.wood=#ff0000",
            "layer.land.where.depth.max=5",
            "layer.land.where.name=",
            "layer.land.where.'a b'=[1, \"x\"]",
            "layer.land.line.width_m={ by = \"w\", stops = [[0, 1], [1, 2]] }",
            "layer.land.features.0.properties.depth=7",
        ],
    )
    .unwrap();
    let land = &scene.layers[0];
    assert_eq!(land.order, Order::Size);
    assert_eq!(land.columns(), ["CLASS", "a", "a b", "depth", "is wet", "lanes", "w"]);
    let LayerSource::Inline(features) = &land.source else { panic!("not inline") };
    assert_eq!(features[0].properties[2], ("depth".into(), Attribute::Integer(7)));
}
