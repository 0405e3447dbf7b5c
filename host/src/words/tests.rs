use super::*;

const NODE: Record = Record {
    name: "node",
    fields: &[Field::new("min", 3), Field::new("phi", 1), Field::index("light")],
};

#[test]
fn equal_words_compare_equal() {
    let words: Vec<u32> = (0..5 * 40_000).collect();
    let comparison = compare_words(&NODE, &words, &words).unwrap();
    assert_eq!(
        comparison,
        Comparison {
            compared: 200_000,
            different: 0,
            first: None
        }
    );
}

#[test]
fn the_first_difference_is_named() {
    let expected = vec![1.0f32.to_bits(); 5 * 40_000];
    let mut actual = expected.clone();
    for at in [5 * 39_999, 5 * 20_000 + 3, 5 * 20_000 + 2] {
        actual[at] += 2;
    }
    let comparison = compare_words(&NODE, &expected, &actual).unwrap();
    assert_eq!(comparison.different, 3);
    let first = comparison.first.unwrap();
    assert_eq!((first.index, first.field.as_str()), (20_000, "min[2]"));
    let text = "node 20000, min[2]: expected 0x3f800000 (1e0), got 0x3f800002 (1.0000002e0), 2 ulp apart";
    assert_eq!(first.to_string(), text);
}

#[test]
fn unwritten_words_differ_even_from_themselves() {
    let words = [0, 0, 0, UNWRITTEN, UNWRITTEN];
    let comparison = compare_words(&NODE, &words, &words).unwrap();
    assert_eq!(
        comparison.different, 1,
        "the index may be all ones, the flux may not"
    );
    let first = comparison.first.unwrap();
    assert_eq!(first.field, "phi");
    assert!(first.to_string().ends_with("never written"), "{first}");
}

#[test]
fn lengths_must_agree() {
    let length = CompareError::Length {
        record: "node",
        expected: 5,
        actual: 10,
    };
    assert_eq!(compare_words(&NODE, &[0; 5], &[0; 10]), Err(length));
    let ragged = CompareError::Ragged {
        record: "node",
        words: 6,
        size: 5,
    };
    assert_eq!(compare_words(&NODE, &[0; 6], &[0; 6]), Err(ragged));
    assert_eq!(compare_words(&NODE, &[], &[]), Ok(Comparison::default()));
}

#[test]
fn ulps_count_floats() {
    assert_eq!(ulp_distance(0, 0x8000_0000), Some(0));
    assert_eq!(ulp_distance(1, 0x8000_0001), Some(2));
    assert_eq!(
        ulp_distance(1.0f32.to_bits(), 1.0f32.next_down().to_bits()),
        Some(1)
    );
    assert_eq!(
        ulp_distance(f32::NEG_INFINITY.to_bits(), f32::INFINITY.to_bits()),
        Some(2 * 0x7f80_0000)
    );
    assert_eq!(ulp_distance(f32::NAN.to_bits(), 0), None);
}
