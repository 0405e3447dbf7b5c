// Functions of lightbvh (docs/shaders.md). Written by `print-functions` from compiled kernels; edits are lost.

struct LightbvhTree {
    root: u32,
    trail_words: u32,
    live: u32,
    lights: u32,
    depth: u32,
    top: u32,
    above: u32,
    places: u32,
    parts: u32,
}

struct LightbvhNodes {
    list: array<array<array<u32, 8>, 6>>,
}

struct LightbvhInstance {
    root: u32,
    blas: u32,
    first: u32,
    first_light: u32,
    count: u32,
    listed: u32,
    columns: array<array<f32, 3>, 3>,
    translation: array<f32, 3>,
    inverse: array<array<f32, 3>, 3>,
    per_inverse: f32,
    flux: f32,
    radiance: array<f32, 3>,
    mask: u32,
    mirrored: u32,
}

struct LightbvhInstances {
    list: array<LightbvhInstance>,
}

struct LightbvhTrails {
    list: array<u32>,
}

struct LightbvhType14_ {
    member: array<f32, 3>,
    member_1: array<f32, 3>,
}

struct LightbvhType16_ {
    member: LightbvhType14_,
    member_1: array<u32, 2>,
}

struct LightbvhType19_ {
    member: u32,
    member_1: u32,
    member_2: f32,
}

struct LightbvhLightSample {
    light: u32,
    instance: u32,
    pmf: f32,
}

struct LightbvhType23_ {
    member: u32,
    member_1: u32,
}

struct LightbvhType24_ {
    member: LightbvhType23_,
    member_1: LightbvhType23_,
}

struct LightbvhType25_ {
    member: f32,
    member_1: f32,
}

struct LightbvhType26_ {
    member: LightbvhType24_,
    member_1: LightbvhType23_,
    member_2: LightbvhType14_,
    member_3: LightbvhType25_,
    member_4: u32,
    member_5: u32,
    member_6: u32,
    member_7: u32,
    member_8: u32,
    member_9: u32,
    member_10: u32,
    member_11: u32,
    member_12: bool,
    member_13: bool,
}

struct LightbvhType27_ {
    member: u32,
    member_1: u32,
    member_2: LightbvhType26_,
}

struct LightbvhType29_ {
    member: array<f32, 3>,
    member_1: array<f32, 3>,
    member_2: array<f32, 3>,
}

struct LightbvhType30_ {
    member: LightbvhType29_,
    member_1: array<u32, 2>,
}

struct LightbvhType31_ {
    member: LightbvhType24_,
    member_1: LightbvhType23_,
    member_2: LightbvhType25_,
    member_3: u32,
    member_4: u32,
    member_5: u32,
    member_6: u32,
    member_7: u32,
    member_8: u32,
    member_9: u32,
    member_10: LightbvhType29_,
    member_11: u32,
    member_12: bool,
    member_13: bool,
}

struct LightbvhType32_ {
    member: u32,
    member_1: u32,
    member_2: LightbvhType31_,
}

struct LightbvhLight {
    p: array<array<f32, 3>, 3>,
    radiance: array<f32, 3>,
    mesh: u32,
    flags: u32,
}

struct LightbvhLights {
    list: array<LightbvhLight>,
}

struct LightbvhType38_ {
    member: array<f32, 3>,
    member_1: f32,
    member_2: array<f32, 3>,
    member_3: u32,
    member_4: array<f32, 3>,
}

struct LightbvhLightPoint {
    p: vec3<f32>,
    density: f32,
    normal: vec3<f32>,
    flags: u32,
    radiance: vec3<f32>,
}

@group(0) @binding(4)
var<uniform> lightbvh_tree: LightbvhTree;
@group(0) @binding(0)
var<storage> lightbvh_nodes: LightbvhNodes;
@group(0) @binding(1)
var<storage> lightbvh_instances: LightbvhInstances;
@group(0) @binding(2)
var<storage> lightbvh_trails: LightbvhTrails;
@group(0) @binding(3)
var<storage> lightbvh_lights: LightbvhLights;

fn lightbvh_sample(p: vec3<f32>, n: vec3<f32>, number: vec2<u32>) -> LightbvhLightSample {
    var queries: LightbvhType16_;
    var results: LightbvhType19_;
    var v0_: array<f32, 8>;
    var v1_: u32;
    var v2_: u32;
    var v3_: u32;
    var v4_: u32;
    var v5_: u32;
    var v6_: u32;
    var v7_: u32;
    var v8_: u32;
    var v9_: u32;
    var v10_: u32;
    var v11_: u32;
    var v12_: u32;
    var v13_: bool;
    var v14_: u32;
    var v15_: u32;
    var v16_: u32;
    var v17_: bool;
    var v18_: bool;
    var v19_: LightbvhType24_;
    var v20_: u32;
    var v21_: u32;
    var v22_: u32;
    var v23_: u32;
    var v24_: bool;
    var v25_: u32;
    var v26_: LightbvhType23_;
    var v27_: u32;
    var v28_: u32;
    var v29_: u32;
    var v30_: LightbvhType23_;
    var v31_: u32;
    var v32_: u32;
    var v33_: LightbvhType23_;
    var v34_: u32;
    var v35_: bool;
    var v36_: bool;
    var v37_: LightbvhType23_;
    var v38_: bool;
    var v39_: LightbvhType24_;
    var v40_: bool;
    var v41_: LightbvhType24_;
    var v42_: u32;
    var v43_: u32;
    var v44_: bool;
    var v45_: LightbvhType27_;
    var v46_: bool;
    var v47_: LightbvhType23_;
    var v48_: LightbvhType23_;
    var v49_: LightbvhType23_;
    var v50_: LightbvhType23_;
    var v51_: LightbvhType23_;
    var v52_: bool;
    var v53_: u32;
    var v54_: u32;
    var v55_: u32;
    var v56_: u32;
    var v57_: i32;
    var v58_: u32;
    var v59_: bool;
    var v60_: LightbvhType27_;
    var v61_: u32;
    var v62_: u32;
    var v63_: LightbvhType27_;
    var v64_: f32;
    var v65_: f32;
    var v66_: f32;
    var v67_: f32;
    var v68_: LightbvhType27_;
    var v69_: bool;
    var v70_: LightbvhType27_;
    var v71_: bool;
    var v72_: bool;
    var v73_: LightbvhType27_;
    var v74_: LightbvhType27_;
    var v75_: LightbvhType27_;
    var v76_: LightbvhType27_;
    var v77_: u32;
    var v78_: u32;
    var v79_: LightbvhType27_;
    var v80_: LightbvhType27_;
    var v81_: f32;
    var v82_: u32;
    var v83_: u32;
    var v84_: bool;
    var v85_: u32;
    var v86_: i32;
    var v87_: u32;
    var v88_: i32;
    var v89_: u32;
    var v90_: u32;
    var v91_: u32;
    var v92_: u32;
    var v93_: bool;
    var v94_: u32;
    var v95_: i32;
    var v96_: u32;
    var v97_: i32;
    var v98_: u32;
    var v99_: u32;
    var v100_: u32;
    var v101_: u32;
    var v102_: bool;
    var v103_: LightbvhType19_;

    queries = LightbvhType16_(LightbvhType14_(array<f32, 3>(p.x, p.y, p.z), array<f32, 3>(n.x, n.y, n.z)), array<u32, 2>(number.x, number.y));
    switch bitcast<i32>(0u) {
        default: {
            let _e141 = arrayLength((&lightbvh_nodes.list));
            let _e144 = arrayLength((&lightbvh_instances.list));
            let _e147 = arrayLength((&lightbvh_trails.list));
            let _e150 = lightbvh_tree.top;
            let _e153 = lightbvh_tree.root;
            let _e156 = lightbvh_tree.above;
            let _e159 = lightbvh_tree.places;
            let _e162 = lightbvh_tree.parts;
            let _e165 = lightbvh_tree.trail_words;
            let _e168 = lightbvh_tree.live;
            let _e171 = lightbvh_tree.lights;
            let _e174 = lightbvh_tree.depth;
            let _e176 = queries;
            v40_ = false;
            v41_ = LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u));
            v42_ = 4294967295u;
            v43_ = 4294967295u;
            if ((_e176.member_1[0] >> bitcast<u32>(10u)) < 65536u) {
                let _e191 = ((_e176.member_1[0] << bitcast<u32>(6u)) | ((_e176.member_1[1] >> bitcast<u32>(1i)) >> bitcast<u32>(25u)));
                let _e193 = (_e176.member_1[1] << bitcast<u32>(6u));
                let _e194 = (_e168 > 0u);
                v1_ = u32();
                v2_ = u32();
                if _e194 {
                    let _e247 = (_e193 >> bitcast<u32>(16i));
                    let _e248 = (_e193 & 65535u);
                    let _e250 = (_e168 >> bitcast<u32>(16i));
                    let _e251 = (_e168 & 65535u);
                    let _e256 = ((_e247 * _e251) + ((_e248 * _e251) >> bitcast<u32>(16i)));
                    let _e267 = (_e193 * _e168);
                    let _e269 = (_e191 >> bitcast<u32>(16i));
                    let _e270 = (_e191 & 65535u);
                    let _e275 = ((_e269 * _e251) + ((_e270 * _e251) >> bitcast<u32>(16i)));
                    let _e286 = (_e191 * _e168);
                    let _e287 = (_e286 + (((_e247 * _e250) + (_e256 >> bitcast<u32>(16i))) + (((_e248 * _e250) + (_e256 & 65535u)) >> bitcast<u32>(16i))));
                    let _e290 = ((((_e269 * _e250) + (_e275 >> bitcast<u32>(16i))) + (((_e270 * _e250) + (_e275 & 65535u)) >> bitcast<u32>(16i))) + select(0u, 1u, (_e287 < _e286)));
                    let _e291 = (_e290 < _e144);
                    v7_ = 4294967295u;
                    v8_ = 4294967295u;
                    if _e291 {
                        if _e291 {
                        } else {
                            break;
                        }
                        let _e294 = lightbvh_instances.list[_e290].listed;
                        let _e295 = (_e294 < _e144);
                        v5_ = 4294967295u;
                        v6_ = 4294967295u;
                        if _e295 {
                            if _e295 {
                            } else {
                                break;
                            }
                            let _e298 = lightbvh_instances.list[_e294].count;
                            let _e299 = (_e298 > 0u);
                            v4_ = 4294967295u;
                            if _e299 {
                                let _e302 = lightbvh_instances.list[_e294].first;
                                let _e304 = (_e267 >> bitcast<u32>(16i));
                                let _e305 = (_e267 & 65535u);
                                let _e307 = (_e298 >> bitcast<u32>(16i));
                                let _e308 = (_e298 & 65535u);
                                let _e313 = ((_e304 * _e308) + ((_e305 * _e308) >> bitcast<u32>(16i)));
                                let _e325 = (_e287 >> bitcast<u32>(16i));
                                let _e326 = (_e287 & 65535u);
                                let _e331 = ((_e325 * _e308) + ((_e326 * _e308) >> bitcast<u32>(16i)));
                                let _e342 = (_e287 * _e298);
                                v4_ = (_e302 + ((((_e325 * _e307) + (_e331 >> bitcast<u32>(16i))) + (((_e326 * _e307) + (_e331 & 65535u)) >> bitcast<u32>(16i))) + select(0u, 1u, ((_e342 + (((_e304 * _e307) + (_e313 >> bitcast<u32>(16i))) + (((_e305 * _e307) + (_e313 & 65535u)) >> bitcast<u32>(16i)))) < _e342))));
                            }
                            let _e349 = v4_;
                            v5_ = _e349;
                            v6_ = select(4294967295u, _e294, _e299);
                        }
                        let _e352 = v5_;
                        let _e354 = v6_;
                        v7_ = _e352;
                        v8_ = _e354;
                    }
                    let _e356 = v7_;
                    let _e358 = v8_;
                    v1_ = _e356;
                    v2_ = _e358;
                }
                let _e196 = v1_;
                let _e198 = v2_;
                v9_ = _e196;
                v10_ = _e198;
                if _e194 {
                } else {
                    v3_ = 4294967295u;
                    if (_e171 > 0u) {
                        let _e201 = (_e193 >> bitcast<u32>(16i));
                        let _e202 = (_e193 & 65535u);
                        let _e204 = (_e171 >> bitcast<u32>(16i));
                        let _e205 = (_e171 & 65535u);
                        let _e210 = ((_e201 * _e205) + ((_e202 * _e205) >> bitcast<u32>(16i)));
                        let _e222 = (_e191 >> bitcast<u32>(16i));
                        let _e223 = (_e191 & 65535u);
                        let _e228 = ((_e222 * _e205) + ((_e223 * _e205) >> bitcast<u32>(16i)));
                        let _e239 = (_e191 * _e171);
                        v3_ = ((((_e222 * _e204) + (_e228 >> bitcast<u32>(16i))) + (((_e223 * _e204) + (_e228 & 65535u)) >> bitcast<u32>(16i))) + select(0u, 1u, ((_e239 + (((_e201 * _e204) + (_e210 >> bitcast<u32>(16i))) + (((_e202 * _e204) + (_e210 & 65535u)) >> bitcast<u32>(16i)))) < _e239)));
                    }
                    let _e245 = v3_;
                    v9_ = _e245;
                    v10_ = 4294967295u;
                }
                let _e360 = v9_;
                let _e362 = v10_;
                let _e363 = (_e362 < _e144);
                v12_ = u32();
                v13_ = true;
                if _e363 {
                    v11_ = u32();
                    if _e194 {
                        if _e363 {
                        } else {
                            break;
                        }
                        let _e366 = lightbvh_instances.list[_e362].first;
                        let _e370 = lightbvh_instances.list[_e362].first_light;
                        v11_ = ((_e360 - _e366) + _e370);
                    }
                    let _e373 = v11_;
                    v12_ = _e373;
                    v13_ = select(true, false, _e194);
                }
                let _e376 = v12_;
                let _e378 = v13_;
                let _e380 = (select(_e376, _e360, _e378) * _e165);
                let _e381 = (_e380 < _e147);
                v14_ = 0u;
                if _e381 {
                    if _e381 {
                    } else {
                        break;
                    }
                    let _e383 = lightbvh_trails.list[_e380];
                    v14_ = _e383;
                }
                let _e385 = v14_;
                v16_ = u32();
                v17_ = true;
                if (_e165 == 2u) {
                    let _e387 = (_e380 + 1u);
                    let _e388 = (_e387 < _e147);
                    v15_ = u32();
                    if _e388 {
                        if _e388 {
                        } else {
                            break;
                        }
                        let _e390 = lightbvh_trails.list[_e387];
                        v15_ = _e390;
                    }
                    let _e392 = v15_;
                    v16_ = _e392;
                    v17_ = select(true, false, _e388);
                }
                let _e395 = v16_;
                let _e397 = v17_;
                let _e398 = select(_e395, 0u, _e397);
                v18_ = bool();
                v19_ = LightbvhType24_();
                if _e363 {
                    let _e405 = (_e159 + _e362);
                    let _e406 = (_e405 < _e147);
                    v20_ = 4294967295u;
                    if _e406 {
                        if _e406 {
                        } else {
                            break;
                        }
                        let _e408 = lightbvh_trails.list[_e405];
                        v20_ = _e408;
                    }
                    let _e410 = v20_;
                    v23_ = u32();
                    v24_ = true;
                    if (_e410 != 4294967295u) {
                        let _e412 = (_e410 >= 2147483648u);
                        v22_ = u32();
                        if _e412 {
                            let _e416 = (_e162 + ((_e410 - 2147483648u) + (_e385 & 7u)));
                            let _e417 = (_e416 < _e147);
                            v21_ = 4294967295u;
                            if _e417 {
                                if _e417 {
                                } else {
                                    break;
                                }
                                let _e419 = lightbvh_trails.list[_e416];
                                v21_ = _e419;
                            }
                            let _e421 = v21_;
                            v22_ = _e421;
                        }
                        let _e423 = v22_;
                        v23_ = _e423;
                        v24_ = select(true, false, _e412);
                    }
                    let _e426 = v23_;
                    let _e428 = v24_;
                    v25_ = 0u;
                    v26_ = LightbvhType23_(0u, 0u);
                    v27_ = select(_e426, _e410, _e428);
                    loop {
                        let _e431 = v25_;
                        let _e433 = v26_;
                        let _e435 = v27_;
                        v37_ = _e433;
                        v32_ = u32();
                        v33_ = LightbvhType23_();
                        v34_ = u32();
                        v35_ = false;
                        if (_e435 < 2147483648u) {
                            let _e437 = (_e431 < 20u);
                            v29_ = u32();
                            v30_ = LightbvhType23_();
                            v31_ = u32();
                            if _e437 {
                                let _e456 = (_e156 + (_e435 >> bitcast<u32>(3u)));
                                let _e457 = (_e456 < _e147);
                                v28_ = 4294967295u;
                                if _e457 {
                                    if _e457 {
                                    } else {
                                        v36_ = true;
                                        break;
                                    }
                                    let _e459 = lightbvh_trails.list[_e456];
                                    v28_ = _e459;
                                }
                                let _e461 = v28_;
                                v29_ = (_e431 + 1u);
                                v30_ = LightbvhType23_((((_e433.member << bitcast<u32>(3u)) | ((_e435 & 7u) & 7u)) & 1073741823u), (((_e433.member_1 << bitcast<u32>(3u)) | ((_e433.member >> bitcast<u32>(27u)) & 7u)) & 1073741823u));
                                v31_ = _e461;
                            }
                            let _e464 = v29_;
                            let _e466 = v30_;
                            let _e468 = v31_;
                            v32_ = _e464;
                            v33_ = _e466;
                            v34_ = _e468;
                            v35_ = _e437;
                        }
                        let _e470 = v32_;
                        let _e472 = v33_;
                        let _e474 = v34_;
                        let _e476 = v35_;
                        continue;
                        continuing {
                            v25_ = _e470;
                            v26_ = _e472;
                            v27_ = _e474;
                            v36_ = false;
                            break if !(_e476);
                        }
                    }
                    let _e479 = v36_;
                    if _e479 {
                        break;
                    }
                    let _e482 = v37_;
                    v18_ = _e479;
                    v19_ = LightbvhType24_(_e482, LightbvhType23_(_e385, _e398));
                }
                let _e400 = v18_;
                let _e402 = v19_;
                v38_ = _e400;
                v39_ = _e402;
                if _e363 {
                } else {
                    v38_ = false;
                    v39_ = LightbvhType24_(LightbvhType23_(_e385, _e398), LightbvhType23_(0u, 0u));
                }
                let _e485 = v38_;
                let _e487 = v39_;
                v40_ = _e485;
                v41_ = _e487;
                v42_ = _e362;
                v43_ = _e360;
            }
            let _e489 = v40_;
            let _e491 = v41_;
            let _e493 = v42_;
            let _e495 = v43_;
            let _e498 = (_e174 == 0u);
            let _e500 = LightbvhType26_(_e491, LightbvhType23_(_e176.member_1[0], _e176.member_1[1]), _e176.member, LightbvhType25_(0f, 1f), 0u, (_e153 + _e150), 4294967295u, 4294967295u, 0u, 4194304u, 0u, _e174, _e498, (_e495 != 4294967295u));
            let _e503 = (bitcast<u32>(21i) - firstLeadingBit(4128767u));
            let _e505 = select(22u, _e503, (_e503 < 22u));
            let _e513 = (_e505 & 31u);
            let _e534 = LightbvhType26_(_e500.member, LightbvhType23_((((_e176.member_1[0] - 67108864u) << bitcast<u32>(_e513)) | ((_e176.member_1[1] >> bitcast<u32>(1i)) >> bitcast<u32>(((31u - _e505) & 31u)))), (_e176.member_1[1] << bitcast<u32>(_e513))), _e500.member_2, _e500.member_3, _e500.member_4, _e500.member_5, _e500.member_6, _e500.member_7, _e500.member_8, _e500.member_9, _e500.member_10, _e500.member_11, _e500.member_12, _e500.member_13);
            let _e551 = LightbvhType26_(_e534.member, _e534.member_1, _e534.member_2, _e534.member_3, _e534.member_4, _e534.member_5, _e534.member_6, _e534.member_7, _e534.member_8, (4128768u << bitcast<u32>(_e513)), _e534.member_10, _e534.member_11, _e534.member_12, _e534.member_13);
            v44_ = _e489;
            v45_ = LightbvhType27_(_e495, _e493, LightbvhType26_(_e551.member, _e551.member_1, _e551.member_2, _e551.member_3, _e551.member_4, _e551.member_5, _e551.member_6, _e551.member_7, _e551.member_8, _e551.member_9, _e505, _e551.member_11, _e551.member_12, _e551.member_13));
            v46_ = _e498;
            loop {
                let _e569 = v44_;
                let _e571 = v45_;
                let _e573 = v46_;
                v73_ = _e571;
                v74_ = _e571;
                v75_ = _e571;
                v76_ = _e571;
                v79_ = _e571;
                v80_ = _e571;
                v69_ = _e569;
                v70_ = LightbvhType27_();
                v71_ = bool();
                if _e573 {
                } else {
                    let _e576 = (_e571.member_2.member_5 < _e141);
                    let _e577 = select(0u, _e571.member_2.member_5, _e576);
                    if (_e577 < _e141) {
                    } else {
                        v72_ = true;
                        break;
                    }
                    let _e606 = lightbvh_nodes.list[_e577][0u][3u];
                    let _e609 = (bitcast<i32>((_e606 & 255u)) - 127i);
                    let _e620 = lightbvh_nodes.list[_e577][0u][0u];
                    let _e625 = lightbvh_nodes.list[_e577][0u][1u];
                    let _e630 = lightbvh_nodes.list[_e577][0u][2u];
                    let _e632 = (bitcast<f32>(_e620) - _e571.member_2.member_2.member[0]);
                    let _e633 = (bitcast<f32>(_e625) - _e571.member_2.member_2.member[1]);
                    let _e634 = (bitcast<f32>(_e630) - _e571.member_2.member_2.member[2]);
                    let _e637 = bitcast<f32>((bitcast<u32>(_e632) & 2147483647u));
                    let _e640 = bitcast<f32>((bitcast<u32>(_e633) & 2147483647u));
                    let _e643 = bitcast<f32>((bitcast<u32>(_e634) & 2147483647u));
                    let _e645 = select(_e640, _e637, (_e637 > _e640));
                    let _e653 = (bitcast<i32>(((bitcast<u32>(select(_e643, _e645, (_e645 > _e643))) >> bitcast<u32>(23i)) & 255u)) - 127i);
                    let _e655 = select(_e609, _e653, (_e653 > _e609));
                    let _e656 = (_e609 - _e655);
                    let _e658 = select(_e656, -40i, (_e656 < -40i));
                    let _e659 = -(_e655);
                    let _e661 = select(_e659, -126i, (_e659 < -126i));
                    let _e668 = bitcast<f32>((bitcast<u32>((select(_e661, 127i, (_e661 > 127i)) + 127i)) << bitcast<u32>(23i)));
                    let _e673 = select(_e658, -126i, (_e658 < -126i));
                    let _e680 = bitcast<f32>((bitcast<u32>((select(_e673, 127i, (_e673 > 127i)) + 127i)) << bitcast<u32>(23i)));
                    let _e681 = (_e680 * 0.0000000004656613f);
                    let _e693 = (2f * 8f);
                    let _e694 = (bitcast<f32>((bitcast<u32>(_e571.member_2.member_2.member_1[0]) & 2147483647u)) * _e693);
                    let _e695 = (bitcast<f32>((bitcast<u32>(_e571.member_2.member_2.member_1[1]) & 2147483647u)) * _e693);
                    let _e696 = (bitcast<f32>((bitcast<u32>(_e571.member_2.member_2.member_1[2]) & 2147483647u)) * _e693);
                    v0_ = array<f32, 8>(0f, 0f, 0f, 0f, 0f, 0f, 0f, 0f);
                    v47_ = LightbvhType23_(0u, 8u);
                    loop {
                        let _e703 = v47_;
                        let _e706 = (_e703.member < _e703.member_1);
                        v48_ = LightbvhType23_();
                        v49_ = LightbvhType23_();
                        if _e706 {
                            v48_ = LightbvhType23_((_e703.member + 1u), _e703.member_1);
                            v49_ = LightbvhType23_(1u, _e703.member);
                        }
                        let _e708 = v48_;
                        let _e710 = v49_;
                        v50_ = _e708;
                        v51_ = _e710;
                        if _e706 {
                        } else {
                            v50_ = _e703;
                            v51_ = LightbvhType23_(0u, LightbvhType23_().member_1);
                        }
                        let _e720 = v50_;
                        let _e722 = v51_;
                        let _e726 = (bitcast<i32>(_e722.member) != 0i);
                        if _e726 {
                            let _e727 = (_e722.member_1 < 8u);
                            if _e727 {
                            } else {
                                v52_ = true;
                                break;
                            }
                            let _e731 = lightbvh_nodes.list[_e577][1u][_e722.member_1];
                            if _e727 {
                            } else {
                                v52_ = true;
                                break;
                            }
                            let _e735 = lightbvh_nodes.list[_e577][2u][_e722.member_1];
                            if _e727 {
                            } else {
                                v52_ = true;
                                break;
                            }
                            let _e739 = lightbvh_nodes.list[_e577][3u][_e722.member_1];
                            if _e727 {
                            } else {
                                v52_ = true;
                                break;
                            }
                            let _e743 = lightbvh_nodes.list[_e577][4u][_e722.member_1];
                            let _e759 = ((_e632 * _e668) + (f32(bitcast<i32>(_e731)) * _e681));
                            let _e760 = ((_e633 * _e668) + (f32(bitcast<i32>((_e731 << bitcast<u32>(15u)))) * _e681));
                            let _e761 = ((_e634 * _e668) + (f32(bitcast<i32>(_e735)) * _e681));
                            let _e766 = bitcast<f32>((((_e743 << bitcast<u32>(20u)) & 267386880u) + (bitcast<u32>(_e680) + 4043309056u)));
                            let _e771 = (f32(bitcast<i32>((_e735 << bitcast<u32>(15u)))) * 0.0000000004656613f);
                            let _e773 = f32(bitcast<i32>(_e739));
                            let _e777 = f32(bitcast<i32>((_e739 << bitcast<u32>(8u))));
                            let _e781 = f32(bitcast<i32>((_e739 << bitcast<u32>(16u))));
                            let _e785 = (f32(bitcast<i32>((_e739 & 255u))) * 0.003921569f);
                            let _e802 = (_e766 * _e766);
                            let _e808 = ((((_e759 * _e759) + (_e760 * _e760)) + (_e761 * _e761)) + 0.0000000000000008881784f);
                            let _e812 = (_e808 + (1.25f * _e802));
                            let _e817 = bitcast<f32>((1595932665u - (bitcast<u32>(_e812) >> bitcast<u32>(1i))));
                            let _e822 = (_e817 * (0.70395225f * (2.3892446f - (_e812 * (_e817 * _e817)))));
                            let _e823 = (_e766 * _e822);
                            let _e828 = ((((_e571.member_2.member_2.member_1[0] * 0.0000000004656613f) * _e773) + ((_e571.member_2.member_2.member_1[1] * 0.0000000004656613f) * _e777)) + ((_e571.member_2.member_2.member_1[2] * 0.0000000004656613f) * _e781));
                            let _e833 = (0.03162278f + (_e823 * (1f + (_e771 * (_e828 * _e828)))));
                            let _e839 = (((((_e571.member_2.member_2.member_1[0] + _e571.member_2.member_2.member_1[0]) * _e759) + ((_e571.member_2.member_2.member_1[1] + _e571.member_2.member_2.member_1[1]) * _e760)) + ((_e571.member_2.member_2.member_1[2] + _e571.member_2.member_2.member_1[2]) * _e761)) * _e822);
                            let _e841 = (_e839 + ((((_e694 + _e695) + _e696) + ((((_e694 * 0.0000000004656613f) * f32(bitcast<i32>(_e743))) + ((_e695 * 0.0000000004656613f) * f32(bitcast<i32>((_e743 << bitcast<u32>(8u)))))) + ((_e696 * 0.0000000004656613f) * f32(bitcast<i32>((_e743 << bitcast<u32>(16u))))))) * _e823));
                            let _e843 = select(0.0001f, _e841, (_e841 > 0.0001f));
                            let _e849 = (bitcast<f32>((bitcast<u32>(_e839) & 2147483647u)) + _e833);
                            let _e855 = (1f + _e771);
                            let _e861 = ((((_e773 * _e759) + (_e777 * _e760)) + (_e781 * _e761)) * (-2f * 0.0000000004656613f));
                            let _e864 = (_e766 * select(_e785, _e855, (_e855 > _e785)));
                            let _e866 = (_e808 - (2.5f * _e802));
                            let _e868 = (0.25f * (_e861 * _e861));
                            let _e874 = ((select(_e868, _e866, (_e866 > _e868)) + 0.0000000000000008881784f) + (1.25f * (_e864 * _e864)));
                            let _e879 = bitcast<f32>((1595932665u - (bitcast<u32>(_e874) >> bitcast<u32>(1i))));
                            let _e884 = (_e879 * (0.70395225f * (2.3892446f - (_e874 * (_e879 * _e879)))));
                            let _e886 = ((_e766 * _e884) * _e855);
                            let _e890 = ((0.03162278f + _e886) + (_e785 * (0.5f - _e886)));
                            let _e891 = (_e861 * _e884);
                            let _e895 = (bitcast<f32>((bitcast<u32>(_e891) & 2147483647u)) + _e890);
                            let _e904 = ((_e849 * _e895) * (_e808 + (0.5f * _e802)));
                            let _e907 = bitcast<f32>((2129859015u - bitcast<u32>(_e904)));
                            if _e727 {
                            } else {
                                v52_ = true;
                                break;
                            }
                            v0_[_e722.member_1] = ((bitcast<f32>(((_e735 & 2047u) << bitcast<u32>(19u))) * (((select(0f, _e839, (_e839 > 0f)) * _e849) + (_e833 * select(_e833, _e843, (_e843 < _e833)))) * ((select(0f, _e891, (_e891 > 0f)) * _e895) + (_e890 * _e890)))) * (_e907 * (2f - (_e904 * _e907))));
                        }
                        continue;
                        continuing {
                            v47_ = _e720;
                            v52_ = _e569;
                            break if !(_e726);
                        }
                    }
                    let _e915 = v52_;
                    v72_ = _e915;
                    if _e915 {
                        break;
                    }
                    let _e916 = v0_;
                    let _e938 = (_e571.member_2.member_8 < 20u);
                    v53_ = u32();
                    if _e938 {
                        let _e961 = (_e571.member_2.member_8 < 10u);
                        v55_ = _e571.member_2.member_8;
                        if _e961 {
                        } else {
                            v55_ = (_e571.member_2.member_8 - 10u);
                        }
                        let _e964 = v55_;
                        v53_ = ((select(_e571.member_2.member.member.member_1, _e571.member_2.member.member.member, _e961) >> bitcast<u32>((((_e964 * 3u) & 31u) & 31u))) & 7u);
                    }
                    let _e940 = v53_;
                    v56_ = _e940;
                    if _e938 {
                    } else {
                        let _e945 = (_e571.member_2.member_8 - 20u);
                        let _e946 = (_e945 < 10u);
                        v54_ = _e945;
                        if _e946 {
                        } else {
                            v54_ = (_e571.member_2.member_8 - 30u);
                        }
                        let _e949 = v54_;
                        v56_ = ((select(_e571.member_2.member.member_1.member_1, _e571.member_2.member.member_1.member, _e946) >> bitcast<u32>((((_e949 * 3u) & 31u) & 31u))) & 7u);
                    }
                    let _e973 = v56_;
                    let _e978 = (0u - select(0u, 1u, (_e916[1] > 0f)));
                    let _e979 = (1u & _e978);
                    let _e983 = (0u - select(0u, 1u, (_e916[2] > 0f)));
                    let _e986 = (_e979 ^ ((2u ^ _e979) & _e983));
                    let _e990 = (0u - select(0u, 1u, (_e916[3] > 0f)));
                    let _e993 = (_e986 ^ ((3u ^ _e986) & _e990));
                    let _e997 = (0u - select(0u, 1u, (_e916[4] > 0f)));
                    let _e1000 = (_e993 ^ ((4u ^ _e993) & _e997));
                    let _e1004 = (0u - select(0u, 1u, (_e916[5] > 0f)));
                    let _e1007 = (_e1000 ^ ((5u ^ _e1000) & _e1004));
                    let _e1011 = (0u - select(0u, 1u, (_e916[6] > 0f)));
                    let _e1014 = (_e1007 ^ ((6u ^ _e1007) & _e1011));
                    let _e1018 = (0u - select(0u, 1u, (_e916[7] > 0f)));
                    let _e1021 = (_e1014 ^ ((7u ^ _e1014) & _e1018));
                    let _e1024 = ((((0f + _e916[0]) + _e916[4]) + ((0f + _e916[2]) + _e916[6])) + (((0f + _e916[1]) + _e916[5]) + ((0f + _e916[3]) + _e916[7])));
                    let _e1025 = (_e1024 > 0f);
                    let _e1029 = select(1f, _e1024, _e1025);
                    let _e1030 = bitcast<u32>(_e1029);
                    let _e1035 = bitcast<f32>(((_e1030 & 2147483648u) | (2129859015u - (_e1030 & 2147483647u))));
                    let _e1038 = (_e1035 * (2f - (_e1029 * _e1035)));
                    let _e1042 = ((f32(bitcast<i32>(_e571.member_2.member_9)) * 0.9999695f) * (_e1038 * (2f - (_e1029 * _e1038))));
                    v57_ = 2147483647i;
                    if _e571.member_2.member_13 {
                    } else {
                        v57_ = bitcast<i32>((_e571.member_2.member_1.member >> bitcast<u32>(10u)));
                    }
                    let _e1045 = v57_;
                    let _e1051 = bitcast<i32>((bitcast<u32>(((_e916[0] * _e1042) + 8388608f)) & 8388607u));
                    let _e1058 = (select(1i, _e1051, (_e1051 > 1i)) & bitcast<i32>((0u - select(0u, 1u, (_e916[0] > 0f)))));
                    let _e1059 = bitcast<u32>(_e1058);
                    let _e1060 = (_e1059 & 4294967295u);
                    let _e1062 = bitcast<i32>(select(_e1021, _e973, _e571.member_2.member_13));
                    let _e1066 = (0u - select(0u, 1u, ((_e1058 <= _e1045) && (0i < _e1062))));
                    let _e1067 = (_e1059 & _e1066);
                    let _e1073 = bitcast<i32>((bitcast<u32>(((_e916[1] * _e1042) + 8388608f)) & 8388607u));
                    let _e1078 = (_e1058 + (select(1i, _e1073, (_e1073 > 1i)) & bitcast<i32>(_e978)));
                    let _e1079 = bitcast<u32>(_e1078);
                    let _e1082 = (_e1060 ^ ((_e1079 ^ _e1060) & _e1066));
                    let _e1087 = (0u - select(0u, 1u, ((_e1078 <= _e1045) && (1i < _e1062))));
                    let _e1090 = (_e1067 ^ ((_e1079 ^ _e1067) & _e1087));
                    let _e1097 = bitcast<i32>((bitcast<u32>(((_e916[2] * _e1042) + 8388608f)) & 8388607u));
                    let _e1102 = (_e1078 + (select(1i, _e1097, (_e1097 > 1i)) & bitcast<i32>(_e983)));
                    let _e1103 = bitcast<u32>(_e1102);
                    let _e1106 = (_e1082 ^ ((_e1103 ^ _e1082) & _e1087));
                    let _e1111 = (0u - select(0u, 1u, ((_e1102 <= _e1045) && (2i < _e1062))));
                    let _e1114 = (_e1090 ^ ((_e1103 ^ _e1090) & _e1111));
                    let _e1121 = bitcast<i32>((bitcast<u32>(((_e916[3] * _e1042) + 8388608f)) & 8388607u));
                    let _e1126 = (_e1102 + (select(1i, _e1121, (_e1121 > 1i)) & bitcast<i32>(_e990)));
                    let _e1127 = bitcast<u32>(_e1126);
                    let _e1130 = (_e1106 ^ ((_e1127 ^ _e1106) & _e1111));
                    let _e1135 = (0u - select(0u, 1u, ((_e1126 <= _e1045) && (3i < _e1062))));
                    let _e1138 = (_e1114 ^ ((_e1127 ^ _e1114) & _e1135));
                    let _e1145 = bitcast<i32>((bitcast<u32>(((_e916[4] * _e1042) + 8388608f)) & 8388607u));
                    let _e1150 = (_e1126 + (select(1i, _e1145, (_e1145 > 1i)) & bitcast<i32>(_e997)));
                    let _e1151 = bitcast<u32>(_e1150);
                    let _e1154 = (_e1130 ^ ((_e1151 ^ _e1130) & _e1135));
                    let _e1159 = (0u - select(0u, 1u, ((_e1150 <= _e1045) && (4i < _e1062))));
                    let _e1162 = (_e1138 ^ ((_e1151 ^ _e1138) & _e1159));
                    let _e1169 = bitcast<i32>((bitcast<u32>(((_e916[5] * _e1042) + 8388608f)) & 8388607u));
                    let _e1174 = (_e1150 + (select(1i, _e1169, (_e1169 > 1i)) & bitcast<i32>(_e1004)));
                    let _e1175 = bitcast<u32>(_e1174);
                    let _e1178 = (_e1154 ^ ((_e1175 ^ _e1154) & _e1159));
                    let _e1183 = (0u - select(0u, 1u, ((_e1174 <= _e1045) && (5i < _e1062))));
                    let _e1186 = (_e1162 ^ ((_e1175 ^ _e1162) & _e1183));
                    let _e1193 = bitcast<i32>((bitcast<u32>(((_e916[6] * _e1042) + 8388608f)) & 8388607u));
                    let _e1198 = (_e1174 + (select(1i, _e1193, (_e1193 > 1i)) & bitcast<i32>(_e1011)));
                    let _e1199 = bitcast<u32>(_e1198);
                    let _e1202 = (_e1178 ^ ((_e1199 ^ _e1178) & _e1183));
                    let _e1207 = (0u - select(0u, 1u, ((_e1198 <= _e1045) && (6i < _e1062))));
                    let _e1210 = (_e1186 ^ ((_e1199 ^ _e1186) & _e1207));
                    let _e1217 = bitcast<i32>((bitcast<u32>(((_e916[7] * _e1042) + 8388608f)) & 8388607u));
                    let _e1222 = (_e1198 + (select(1i, _e1217, (_e1217 > 1i)) & bitcast<i32>(_e1018)));
                    let _e1223 = bitcast<u32>(_e1222);
                    let _e1226 = (_e1202 ^ ((_e1223 ^ _e1202) & _e1207));
                    let _e1231 = (0u - select(0u, 1u, ((_e1222 <= _e1045) && (7i < _e1062))));
                    let _e1234 = (_e1210 ^ ((_e1223 ^ _e1210) & _e1231));
                    let _e1237 = select(((((((((_e1066 & 1u) + (_e1087 & 1u)) + (_e1111 & 1u)) + (_e1135 & 1u)) + (_e1159 & 1u)) + (_e1183 & 1u)) + (_e1207 & 1u)) + (_e1231 & 1u)), _e973, _e571.member_2.member_13);
                    let _e1242 = (_e1237 < 8u);
                    let _e1243 = ((_e1025 && (_e1226 > _e1234)) && _e1242);
                    let _e1244 = select(0u, _e1237, _e1242);
                    v58_ = 0u;
                    if _e1243 {
                        v58_ = (select(_e1226, _e571.member_2.member_9, (_e1237 == _e1021)) - _e1234);
                    }
                    let _e1248 = v58_;
                    let _e1249 = (_e1244 < 8u);
                    if _e1249 {
                    } else {
                        v72_ = true;
                        break;
                    }
                    let _e1253 = lightbvh_nodes.list[_e577][1u][_e1244];
                    let _e1254 = (_e1253 & 3u);
                    if _e1249 {
                    } else {
                        v72_ = true;
                        break;
                    }
                    let _e1258 = lightbvh_nodes.list[_e577][5u][_e1244];
                    let _e1262 = ((_e576 && (_e1248 > 0u)) && (_e1248 <= _e571.member_2.member_9));
                    let _e1263 = select(1u, _e1248, _e1262);
                    let _e1265 = ((_e1263 - 1u) & 4194303u);
                    let _e1271 = (select((bitcast<u32>(31i) - firstLeadingBit(_e1265)), 32u, (_e1265 == 0u)) - 10u);
                    let _e1273 = select(22u, _e1271, (_e1271 < 22u));
                    let _e1286 = (_e1273 & 31u);
                    let _e1311 = LightbvhType27_(_e571.member, _e571.member_1, LightbvhType26_(_e571.member_2.member, LightbvhType23_((((_e571.member_2.member_1.member - (select(0u, _e1234, _e1243) << bitcast<u32>(10u))) << bitcast<u32>(_e1286)) | ((_e571.member_2.member_1.member_1 >> bitcast<u32>(1i)) >> bitcast<u32>(((31u - _e1273) & 31u)))), (_e571.member_2.member_1.member_1 << bitcast<u32>(_e1286))), _e571.member_2.member_2, _e571.member_2.member_3, _e571.member_2.member_4, _e571.member_2.member_5, _e571.member_2.member_6, _e571.member_2.member_7, _e571.member_2.member_8, _e571.member_2.member_9, _e571.member_2.member_10, _e571.member_2.member_11, _e571.member_2.member_12, _e571.member_2.member_13));
                    let _e1332 = LightbvhType27_(_e1311.member, _e1311.member_1, LightbvhType26_(_e1311.member_2.member, _e1311.member_2.member_1, _e1311.member_2.member_2, _e1311.member_2.member_3, _e1311.member_2.member_4, _e1311.member_2.member_5, _e1311.member_2.member_6, _e1311.member_2.member_7, _e1311.member_2.member_8, (_e1263 << bitcast<u32>(_e1286)), _e1311.member_2.member_10, _e1311.member_2.member_11, _e1311.member_2.member_12, _e1311.member_2.member_13));
                    let _e1354 = LightbvhType27_(_e1332.member, _e1332.member_1, LightbvhType26_(_e1332.member_2.member, _e1332.member_2.member_1, _e1332.member_2.member_2, _e1332.member_2.member_3, _e1332.member_2.member_4, _e1332.member_2.member_5, _e1332.member_2.member_6, _e1332.member_2.member_7, _e1332.member_2.member_8, _e1332.member_2.member_9, (_e571.member_2.member_10 + _e1273), _e1332.member_2.member_11, _e1332.member_2.member_12, _e1332.member_2.member_13));
                    let _e1355 = (_e571.member_2.member_8 + 1u);
                    v59_ = true;
                    if (_e1355 == 20u) {
                    } else {
                        v59_ = (_e1355 == 40u);
                    }
                    let _e1359 = v59_;
                    let _e1360 = (_e1258 & 134217727u);
                    let _e1364 = (_e1258 >> bitcast<u32>((firstTrailingBit(134217728u) & 31u)));
                    let _e1368 = (_e1360 < _e144);
                    let _e1369 = (((_e1262 && (_e1254 == 3u)) && _e938) && _e1368);
                    let _e1373 = ((_e1262 && (_e1254 == 1u)) && !(_e1359));
                    let _e1395 = LightbvhType27_(_e1354.member, _e1354.member_1, LightbvhType26_(_e1354.member_2.member, _e1354.member_2.member_1, _e1354.member_2.member_2, _e1354.member_2.member_3, _e1354.member_2.member_4, _e1354.member_2.member_5, select(4294967295u, _e1258, (_e1262 && (_e1254 == 2u))), _e1354.member_2.member_7, _e1354.member_2.member_8, _e1354.member_2.member_9, _e1354.member_2.member_10, _e1354.member_2.member_11, _e1354.member_2.member_12, _e1354.member_2.member_13));
                    let _e1398 = (_e571.member_2.member_11 - 1u);
                    let _e1417 = LightbvhType27_(_e1395.member, _e1395.member_1, LightbvhType26_(_e1395.member_2.member, _e1395.member_2.member_1, _e1395.member_2.member_2, _e1395.member_2.member_3, _e1395.member_2.member_4, _e1395.member_2.member_5, _e1395.member_2.member_6, _e1395.member_2.member_7, _e1395.member_2.member_8, _e1395.member_2.member_9, _e1395.member_2.member_10, _e1398, _e1395.member_2.member_12, _e1395.member_2.member_13));
                    let _e1421 = (!((_e1369 || _e1373)) || (_e1398 == 0u));
                    let _e1440 = LightbvhType27_(_e1417.member, _e1417.member_1, LightbvhType26_(_e1417.member_2.member, _e1417.member_2.member_1, _e1417.member_2.member_2, _e1417.member_2.member_3, _e1417.member_2.member_4, _e1417.member_2.member_5, _e1417.member_2.member_6, _e1417.member_2.member_7, _e1417.member_2.member_8, _e1417.member_2.member_9, _e1417.member_2.member_10, _e1417.member_2.member_11, _e1421, _e1417.member_2.member_13));
                    v60_ = LightbvhType27_();
                    if _e1369 {
                        if _e1368 {
                        } else {
                            v72_ = true;
                            break;
                        }
                        let _e1505 = LightbvhType27_(_e1440.member, _e1440.member_1, LightbvhType26_(_e1440.member_2.member, _e1440.member_2.member_1, _e1440.member_2.member_2, _e1440.member_2.member_3, _e1440.member_2.member_4, _e1440.member_2.member_5, _e1440.member_2.member_6, _e1360, _e1440.member_2.member_8, _e1440.member_2.member_9, _e1440.member_2.member_10, _e1440.member_2.member_11, _e1440.member_2.member_12, _e1440.member_2.member_13));
                        let _e1508 = lightbvh_instances.list[_e1360].root;
                        let _e1527 = LightbvhType27_(_e1505.member, _e1505.member_1, LightbvhType26_(_e1505.member_2.member, _e1505.member_2.member_1, _e1505.member_2.member_2, _e1505.member_2.member_3, _e1505.member_2.member_4, _e1508, _e1505.member_2.member_6, _e1505.member_2.member_7, _e1505.member_2.member_8, _e1505.member_2.member_9, _e1505.member_2.member_10, _e1505.member_2.member_11, _e1505.member_2.member_12, _e1505.member_2.member_13));
                        let _e1528 = (_e1508 == 4294967295u);
                        v62_ = 4294967295u;
                        if _e1528 {
                            let _e1531 = lightbvh_instances.list[_e1360].first_light;
                            v62_ = _e1531;
                        }
                        let _e1533 = v62_;
                        let _e1552 = LightbvhType27_(_e1527.member, _e1527.member_1, LightbvhType26_(_e1527.member_2.member, _e1527.member_2.member_1, _e1527.member_2.member_2, _e1527.member_2.member_3, _e1527.member_2.member_4, _e1527.member_2.member_5, _e1533, _e1527.member_2.member_7, _e1527.member_2.member_8, _e1527.member_2.member_9, _e1527.member_2.member_10, _e1527.member_2.member_11, _e1527.member_2.member_12, _e1527.member_2.member_13));
                        let _e1553 = (_e1421 || _e1528);
                        let _e1572 = LightbvhType27_(_e1552.member, _e1552.member_1, LightbvhType26_(_e1552.member_2.member, _e1552.member_2.member_1, _e1552.member_2.member_2, _e1552.member_2.member_3, _e1552.member_2.member_4, _e1552.member_2.member_5, _e1552.member_2.member_6, _e1552.member_2.member_7, _e1552.member_2.member_8, _e1552.member_2.member_9, _e1552.member_2.member_10, _e1552.member_2.member_11, _e1553, _e1552.member_2.member_13));
                        let _e1591 = LightbvhType27_(_e1572.member, _e1572.member_1, LightbvhType26_(_e1572.member_2.member, _e1572.member_2.member_1, _e1572.member_2.member_2, _e1572.member_2.member_3, _e1572.member_2.member_4, _e1572.member_2.member_5, _e1572.member_2.member_6, _e1572.member_2.member_7, 20u, _e1572.member_2.member_9, _e1572.member_2.member_10, _e1572.member_2.member_11, _e1572.member_2.member_12, _e1572.member_2.member_13));
                        v63_ = _e1591;
                        if (_e1364 > 0u) {
                            let _e1594 = select(0u, _e1508, (_e1508 < _e141));
                            if (_e1594 < _e141) {
                            } else {
                                v72_ = true;
                                break;
                            }
                            let _e1597 = ((_e1364 - 1u) % 8u);
                            let _e1598 = (_e1597 < 8u);
                            if _e1598 {
                            } else {
                                v72_ = true;
                                break;
                            }
                            let _e1602 = lightbvh_nodes.list[_e1594][1u][_e1597];
                            let _e1603 = (_e1602 & 3u);
                            if _e1598 {
                            } else {
                                v72_ = true;
                                break;
                            }
                            let _e1607 = lightbvh_nodes.list[_e1594][5u][_e1597];
                            let _e1626 = LightbvhType27_(_e1591.member, _e1591.member_1, LightbvhType26_(_e1591.member_2.member, _e1591.member_2.member_1, _e1591.member_2.member_2, _e1591.member_2.member_3, _e1591.member_2.member_4, _e1607, _e1591.member_2.member_6, _e1591.member_2.member_7, _e1591.member_2.member_8, _e1591.member_2.member_9, _e1591.member_2.member_10, _e1591.member_2.member_11, _e1591.member_2.member_12, _e1591.member_2.member_13));
                            let _e1647 = LightbvhType27_(_e1626.member, _e1626.member_1, LightbvhType26_(_e1626.member_2.member, _e1626.member_2.member_1, _e1626.member_2.member_2, _e1626.member_2.member_3, _e1626.member_2.member_4, _e1626.member_2.member_5, select(4294967295u, _e1607, (_e1603 == 2u)), _e1626.member_2.member_7, _e1626.member_2.member_8, _e1626.member_2.member_9, _e1626.member_2.member_10, _e1626.member_2.member_11, _e1626.member_2.member_12, _e1626.member_2.member_13));
                            let _e1668 = LightbvhType27_(_e1647.member, _e1647.member_1, LightbvhType26_(_e1647.member_2.member, _e1647.member_2.member_1, _e1647.member_2.member_2, _e1647.member_2.member_3, _e1647.member_2.member_4, _e1647.member_2.member_5, _e1647.member_2.member_6, _e1647.member_2.member_7, _e1647.member_2.member_8, _e1647.member_2.member_9, _e1647.member_2.member_10, _e1647.member_2.member_11, (_e1553 || (_e1603 != 1u)), _e1647.member_2.member_13));
                            v63_ = LightbvhType27_(_e1668.member, _e1668.member_1, LightbvhType26_(_e1668.member_2.member, _e1668.member_2.member_1, _e1668.member_2.member_2, _e1668.member_2.member_3, _e1668.member_2.member_4, _e1668.member_2.member_5, _e1668.member_2.member_6, _e1668.member_2.member_7, 21u, _e1668.member_2.member_9, _e1668.member_2.member_10, _e1668.member_2.member_11, _e1668.member_2.member_12, _e1668.member_2.member_13));
                        }
                        let _e1689 = v63_;
                        let _e1699 = lightbvh_instances.list[_e1360].translation[0u];
                        let _e1703 = lightbvh_instances.list[_e1360].translation[1u];
                        let _e1707 = lightbvh_instances.list[_e1360].translation[2u];
                        let _e1708 = (_e176.member.member[0] - _e1699);
                        let _e1709 = (_e176.member.member[1] - _e1703);
                        let _e1710 = (_e176.member.member[2] - _e1707);
                        let _e1715 = select(_e1708, 0f, (bitcast<f32>((bitcast<u32>(_e1708) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1720 = select(_e1709, 0f, (bitcast<f32>((bitcast<u32>(_e1709) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1725 = select(_e1710, 0f, (bitcast<f32>((bitcast<u32>(_e1710) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1730 = lightbvh_instances.list[_e1360].inverse[0u][0u];
                        let _e1735 = lightbvh_instances.list[_e1360].inverse[0u][1u];
                        let _e1740 = lightbvh_instances.list[_e1360].inverse[0u][2u];
                        let _e1748 = lightbvh_instances.list[_e1360].inverse[1u][0u];
                        let _e1753 = lightbvh_instances.list[_e1360].inverse[1u][1u];
                        let _e1758 = lightbvh_instances.list[_e1360].inverse[1u][2u];
                        let _e1769 = lightbvh_instances.list[_e1360].inverse[2u][0u];
                        let _e1774 = lightbvh_instances.list[_e1360].inverse[2u][1u];
                        let _e1779 = lightbvh_instances.list[_e1360].inverse[2u][2u];
                        let _e1783 = (((_e1730 * _e1715) + (_e1748 * _e1720)) + (_e1769 * _e1725));
                        let _e1784 = (((_e1735 * _e1715) + (_e1753 * _e1720)) + (_e1774 * _e1725));
                        let _e1785 = (((_e1740 * _e1715) + (_e1758 * _e1720)) + (_e1779 * _e1725));
                        let _e1796 = lightbvh_instances.list[_e1360].columns[0u][0u];
                        let _e1801 = lightbvh_instances.list[_e1360].columns[0u][1u];
                        let _e1806 = lightbvh_instances.list[_e1360].columns[0u][2u];
                        let _e1811 = (((_e1796 * _e176.member.member_1[0]) + (_e1801 * _e176.member.member_1[1])) + (_e1806 * _e176.member.member_1[2]));
                        let _e1816 = lightbvh_instances.list[_e1360].columns[1u][0u];
                        let _e1821 = lightbvh_instances.list[_e1360].columns[1u][1u];
                        let _e1826 = lightbvh_instances.list[_e1360].columns[1u][2u];
                        let _e1831 = (((_e1816 * _e176.member.member_1[0]) + (_e1821 * _e176.member.member_1[1])) + (_e1826 * _e176.member.member_1[2]));
                        let _e1836 = lightbvh_instances.list[_e1360].columns[2u][0u];
                        let _e1841 = lightbvh_instances.list[_e1360].columns[2u][1u];
                        let _e1846 = lightbvh_instances.list[_e1360].columns[2u][2u];
                        let _e1851 = (((_e1836 * _e176.member.member_1[0]) + (_e1841 * _e176.member.member_1[1])) + (_e1846 * _e176.member.member_1[2]));
                        let _e1856 = select(_e1811, 0f, (bitcast<f32>((bitcast<u32>(_e1811) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1861 = select(_e1831, 0f, (bitcast<f32>((bitcast<u32>(_e1831) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1866 = select(_e1851, 0f, (bitcast<f32>((bitcast<u32>(_e1851) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1871 = (((_e1856 * _e1856) + (_e1861 * _e1861)) + (_e1866 * _e1866));
                        v64_ = 0f;
                        if (_e1871 >= bitcast<f32>(67108864u)) {
                            let _e1878 = bitcast<f32>((1597463007u - (bitcast<u32>(_e1871) >> bitcast<u32>(1i))));
                            let _e1879 = (0.5f * _e1871);
                            let _e1883 = (_e1878 * (1.5f - ((_e1879 * _e1878) * _e1878)));
                            v64_ = (_e1883 * (1.5f - ((_e1879 * _e1883) * _e1883)));
                        }
                        let _e1889 = v64_;
                        let _e1890 = -(1152921500000000000f);
                        v65_ = _e1890;
                        if (_e1783 < _e1890) {
                        } else {
                            v65_ = select(_e1783, 1152921500000000000f, (_e1783 > 1152921500000000000f));
                        }
                        let _e1895 = v65_;
                        v66_ = _e1890;
                        if (_e1784 < _e1890) {
                        } else {
                            v66_ = select(_e1784, 1152921500000000000f, (_e1784 > 1152921500000000000f));
                        }
                        let _e1905 = v66_;
                        v67_ = _e1890;
                        if (_e1785 < _e1890) {
                        } else {
                            v67_ = select(_e1785, 1152921500000000000f, (_e1785 > 1152921500000000000f));
                        }
                        let _e1915 = v67_;
                        let _e1922 = (_e1856 * _e1889);
                        let _e1928 = (_e1861 * _e1889);
                        let _e1934 = (_e1866 * _e1889);
                        v60_ = LightbvhType27_(_e1689.member, _e1689.member_1, LightbvhType26_(_e1689.member_2.member, _e1689.member_2.member_1, LightbvhType14_(array<f32, 3>(select(_e1895, 0f, (bitcast<f32>((bitcast<u32>(_e1895) & 2147483647u)) < 0.00000000000000000086736174f)), select(_e1905, 0f, (bitcast<f32>((bitcast<u32>(_e1905) & 2147483647u)) < 0.00000000000000000086736174f)), select(_e1915, 0f, (bitcast<f32>((bitcast<u32>(_e1915) & 2147483647u)) < 0.00000000000000000086736174f))), array<f32, 3>(select(_e1922, 0f, (bitcast<f32>((bitcast<u32>(_e1922) & 2147483647u)) < 0.00000000000000000086736174f)), select(_e1928, 0f, (bitcast<f32>((bitcast<u32>(_e1928) & 2147483647u)) < 0.00000000000000000086736174f)), select(_e1934, 0f, (bitcast<f32>((bitcast<u32>(_e1934) & 2147483647u)) < 0.00000000000000000086736174f)))), _e1689.member_2.member_3, _e1689.member_2.member_4, _e1689.member_2.member_5, _e1689.member_2.member_6, _e1689.member_2.member_7, _e1689.member_2.member_8, _e1689.member_2.member_9, _e1689.member_2.member_10, _e1689.member_2.member_11, _e1689.member_2.member_12, _e1689.member_2.member_13));
                    }
                    let _e1442 = v60_;
                    v68_ = _e1442;
                    if _e1369 {
                    } else {
                        v61_ = _e571.member_2.member_5;
                        if _e1373 {
                            v61_ = (_e1258 + select(0u, _e150, _e938));
                        }
                        let _e1446 = v61_;
                        let _e1465 = LightbvhType27_(_e1440.member, _e1440.member_1, LightbvhType26_(_e1440.member_2.member, _e1440.member_2.member_1, _e1440.member_2.member_2, _e1440.member_2.member_3, _e1440.member_2.member_4, _e1446, _e1440.member_2.member_6, _e1440.member_2.member_7, _e1440.member_2.member_8, _e1440.member_2.member_9, _e1440.member_2.member_10, _e1440.member_2.member_11, _e1440.member_2.member_12, _e1440.member_2.member_13));
                        v68_ = LightbvhType27_(_e1465.member, _e1465.member_1, LightbvhType26_(_e1465.member_2.member, _e1465.member_2.member_1, _e1465.member_2.member_2, _e1465.member_2.member_3, _e1465.member_2.member_4, _e1465.member_2.member_5, _e1465.member_2.member_6, _e1465.member_2.member_7, (_e571.member_2.member_8 + select(0u, 1u, _e1373)), _e1465.member_2.member_9, _e1465.member_2.member_10, _e1465.member_2.member_11, _e1465.member_2.member_12, _e1465.member_2.member_13));
                    }
                    let _e1962 = v68_;
                    v69_ = _e915;
                    v70_ = _e1962;
                    v71_ = _e1962.member_2.member_12;
                }
                let _e1966 = v69_;
                let _e1968 = v70_;
                let _e1970 = v71_;
                continue;
                continuing {
                    v44_ = _e1966;
                    v45_ = _e1968;
                    v46_ = _e1970;
                    v72_ = _e1966;
                    break if !(select(true, false, _e573));
                }
            }
            let _e1974 = v72_;
            if _e1974 {
                break;
            }
            let _e1976 = v73_;
            let _e1978 = (_e1976.member != 4294967295u);
            let _e1980 = v74_;
            let _e1986 = v75_;
            let _e1990 = v76_;
            let _e1994 = ((_e1980.member_2.member_6 != 4294967295u) && (!(_e1978) || (_e1986.member_2.member_7 == _e1990.member_1)));
            let _e1995 = select(_e1986.member_2.member_7, _e1990.member_1, _e1978);
            v78_ = _e1976.member;
            if _e1978 {
            } else {
                let _e1996 = (_e1986.member_2.member_7 < _e144);
                v77_ = _e1980.member_2.member_6;
                if _e1996 {
                    if _e1996 {
                    } else {
                        break;
                    }
                    let _e1999 = lightbvh_instances.list[_e1986.member_2.member_7].first_light;
                    let _e2003 = lightbvh_instances.list[_e1986.member_2.member_7].first;
                    v77_ = ((_e1980.member_2.member_6 - _e1999) + _e2003);
                }
                let _e2006 = v77_;
                v78_ = _e2006;
            }
            let _e2008 = v78_;
            v81_ = 0f;
            if _e1994 {
                let _e2010 = v79_;
                let _e2016 = v80_;
                let _e2023 = -(bitcast<i32>((22u + select(98u, _e2010.member_2.member_10, (_e2010.member_2.member_10 < 98u)))));
                let _e2025 = select(_e2023, -126i, (_e2023 < -126i));
                v81_ = (f32(bitcast<i32>(_e2016.member_2.member_9)) * bitcast<f32>((bitcast<u32>((select(_e2025, 127i, (_e2025 > 127i)) + 127i)) << bitcast<u32>(23i))));
            }
            let _e2035 = v81_;
            v83_ = u32();
            v84_ = true;
            if (_e168 > 0u) {
                let _e2037 = (_e1995 < _e144);
                v82_ = u32();
                if _e2037 {
                    if _e2037 {
                    } else {
                        break;
                    }
                    let _e2040 = lightbvh_instances.list[_e1995].count;
                    v82_ = _e2040;
                }
                let _e2042 = v82_;
                v83_ = _e2042;
                v84_ = select(true, false, _e2037);
            }
            let _e2045 = v83_;
            let _e2047 = v84_;
            let _e2052 = (select(_e2045, _e171, _e2047) & 2147483647u);
            let _e2057 = bitcast<u32>((f32(65536i) * bitcast<f32>(880803840u)));
            let _e2058 = bitcast<u32>(f32(bitcast<i32>(select(1u, _e2052, (_e2052 > 0u)))));
            let _e2063 = ((_e2057 >> bitcast<u32>(23i)) & 255u);
            let _e2067 = (_e2057 & 8388607u);
            let _e2068 = (_e2067 | 8388608u);
            let _e2069 = (_e2058 & 8388607u);
            let _e2070 = (_e2069 | 8388608u);
            let _e2071 = (_e2068 < _e2070);
            let _e2075 = bitcast<f32>((_e2069 | 1065353216u));
            let _e2076 = bitcast<u32>(_e2075);
            let _e2081 = bitcast<f32>(((_e2076 & 2147483648u) | (2129859015u - (_e2076 & 2147483647u))));
            let _e2084 = (_e2081 * (2f - (_e2075 * _e2081)));
            let _e2087 = (_e2084 * (2f - (_e2075 * _e2084)));
            let _e2091 = ((bitcast<f32>((_e2067 | 1065353216u)) * _e2087) * select(8388608f, 16777216f, _e2071));
            let _e2092 = bitcast<f32>(0u);
            let _e2093 = bitcast<f32>(1333788671u);
            let _e2098 = select(select(u32(_e2091), 0u, (_e2091 < _e2092)), 4294967295u, (_e2091 > _e2093));
            let _e2104 = bitcast<i32>(((_e2068 << bitcast<u32>((select(23i, 24i, _e2071) & 31i))) - (_e2098 * _e2070)));
            let _e2109 = ((f32((_e2104 >> bitcast<u32>(8i))) * _e2087) * 0.000030517578f);
            let _e2110 = bitcast<f32>(3472883712u);
            let _e2111 = bitcast<f32>(1325400063u);
            let _e2118 = select(0i, select(select(i32(_e2109), i32(-2147483648), (_e2109 < _e2110)), 2147483647i, (_e2109 > _e2111)), (_e2109 == _e2109));
            let _e2120 = (_e2098 + bitcast<u32>(_e2118));
            let _e2121 = bitcast<i32>(_e2070);
            let _e2123 = (_e2104 - (_e2118 * _e2121));
            let _e2124 = (_e2123 < 0i);
            v85_ = _e2120;
            if _e2124 {
                v85_ = (_e2120 - 1u);
            }
            let _e2127 = v85_;
            v86_ = _e2123;
            if _e2124 {
                v86_ = (_e2123 + _e2121);
            }
            let _e2130 = v86_;
            let _e2131 = (_e2130 >= _e2121);
            v87_ = _e2127;
            if _e2131 {
                v87_ = (_e2127 + 1u);
            }
            let _e2134 = v87_;
            v88_ = _e2130;
            if _e2131 {
                v88_ = (_e2130 - _e2121);
            }
            let _e2137 = v88_;
            v89_ = _e2134;
            if ((_e2137 * 2i) > _e2121) {
                v89_ = (_e2134 + 1u);
            }
            let _e2142 = v89_;
            let _e2147 = ((bitcast<i32>(_e2063) - bitcast<i32>(((_e2058 >> bitcast<u32>(23i)) & 255u))) + select(127i, 126i, _e2071));
            v92_ = u32();
            v93_ = true;
            if (_e2063 == 0u) {
            } else {
                let _e2149 = (_e2147 <= 0i);
                v91_ = u32();
                if _e2149 {
                } else {
                    v90_ = 2139095040u;
                    if (_e2147 >= 255i) {
                    } else {
                        v90_ = ((bitcast<u32>(_e2147) << bitcast<u32>(23i)) + (_e2142 & 8388607u));
                    }
                    let _e2157 = v90_;
                    v91_ = _e2157;
                }
                let _e2159 = v91_;
                v92_ = _e2159;
                v93_ = _e2149;
            }
            let _e2161 = v92_;
            let _e2163 = v93_;
            let _e2167 = (_e168 & 2147483647u);
            let _e2172 = bitcast<u32>(bitcast<f32>((((_e2057 ^ _e2058) & 2147483648u) | select(_e2161, 0u, _e2163))));
            let _e2173 = bitcast<u32>(f32(bitcast<i32>(select(1u, _e2167, (_e2167 > 0u)))));
            let _e2178 = ((_e2172 >> bitcast<u32>(23i)) & 255u);
            let _e2182 = (_e2172 & 8388607u);
            let _e2183 = (_e2182 | 8388608u);
            let _e2184 = (_e2173 & 8388607u);
            let _e2185 = (_e2184 | 8388608u);
            let _e2186 = (_e2183 < _e2185);
            let _e2190 = bitcast<f32>((_e2184 | 1065353216u));
            let _e2191 = bitcast<u32>(_e2190);
            let _e2196 = bitcast<f32>(((_e2191 & 2147483648u) | (2129859015u - (_e2191 & 2147483647u))));
            let _e2199 = (_e2196 * (2f - (_e2190 * _e2196)));
            let _e2202 = (_e2199 * (2f - (_e2190 * _e2199)));
            let _e2206 = ((bitcast<f32>((_e2182 | 1065353216u)) * _e2202) * select(8388608f, 16777216f, _e2186));
            let _e2211 = select(select(u32(_e2206), 0u, (_e2206 < _e2092)), 4294967295u, (_e2206 > _e2093));
            let _e2217 = bitcast<i32>(((_e2183 << bitcast<u32>((select(23i, 24i, _e2186) & 31i))) - (_e2211 * _e2185)));
            let _e2222 = ((f32((_e2217 >> bitcast<u32>(8i))) * _e2202) * 0.000030517578f);
            let _e2229 = select(0i, select(select(i32(_e2222), i32(-2147483648), (_e2222 < _e2110)), 2147483647i, (_e2222 > _e2111)), (_e2222 == _e2222));
            let _e2231 = (_e2211 + bitcast<u32>(_e2229));
            let _e2232 = bitcast<i32>(_e2185);
            let _e2234 = (_e2217 - (_e2229 * _e2232));
            let _e2235 = (_e2234 < 0i);
            v94_ = _e2231;
            if _e2235 {
                v94_ = (_e2231 - 1u);
            }
            let _e2238 = v94_;
            v95_ = _e2234;
            if _e2235 {
                v95_ = (_e2234 + _e2232);
            }
            let _e2241 = v95_;
            let _e2242 = (_e2241 >= _e2232);
            v96_ = _e2238;
            if _e2242 {
                v96_ = (_e2238 + 1u);
            }
            let _e2245 = v96_;
            v97_ = _e2241;
            if _e2242 {
                v97_ = (_e2241 - _e2232);
            }
            let _e2248 = v97_;
            v98_ = _e2245;
            if ((_e2248 * 2i) > _e2232) {
                v98_ = (_e2245 + 1u);
            }
            let _e2253 = v98_;
            let _e2258 = ((bitcast<i32>(_e2178) - bitcast<i32>(((_e2173 >> bitcast<u32>(23i)) & 255u))) + select(127i, 126i, _e2186));
            v101_ = u32();
            v102_ = true;
            if (_e2178 == 0u) {
            } else {
                let _e2260 = (_e2258 <= 0i);
                v100_ = u32();
                if _e2260 {
                } else {
                    v99_ = 2139095040u;
                    if (_e2258 >= 255i) {
                    } else {
                        v99_ = ((bitcast<u32>(_e2258) << bitcast<u32>(23i)) + (_e2253 & 8388607u));
                    }
                    let _e2268 = v99_;
                    v100_ = _e2268;
                }
                let _e2270 = v100_;
                v101_ = _e2270;
                v102_ = _e2260;
            }
            let _e2272 = v101_;
            let _e2274 = v102_;
            v103_ = LightbvhType19_(4294967295u, 4294967295u, 0f);
            if (_e1978 || _e1994) {
                v103_ = LightbvhType19_(_e2008, _e1995, (_e2035 + bitcast<f32>((((_e2172 ^ _e2173) & 2147483648u) | select(_e2272, 0u, _e2274)))));
            }
            let _e2282 = v103_;
            results = _e2282;
            break;
        }
    }
    let _e2388 = results;
    return LightbvhLightSample(_e2388.member, _e2388.member_1, _e2388.member_2);
}

fn lightbvh_pmf(p_1: vec3<f32>, n_1: vec3<f32>, light: u32, instance: u32) -> f32 {
    var queries_1: LightbvhType16_;
    var results_1: f32;
    var v0_1: array<f32, 8>;
    var v1_1: u32;
    var v2_1: u32;
    var v3_1: bool;
    var v4_1: u32;
    var v5_1: u32;
    var v6_1: u32;
    var v7_1: bool;
    var v8_1: bool;
    var v9_1: LightbvhType24_;
    var v10_1: u32;
    var v11_1: u32;
    var v12_1: u32;
    var v13_1: u32;
    var v14_1: bool;
    var v15_1: u32;
    var v16_1: LightbvhType23_;
    var v17_1: u32;
    var v18_1: u32;
    var v19_1: u32;
    var v20_1: LightbvhType23_;
    var v21_1: u32;
    var v22_1: u32;
    var v23_1: LightbvhType23_;
    var v24_1: u32;
    var v25_1: bool;
    var v26_1: bool;
    var v27_1: LightbvhType23_;
    var v28_1: bool;
    var v29_1: LightbvhType24_;
    var v30_1: bool;
    var v31_1: LightbvhType26_;
    var v32_1: bool;
    var v33_1: LightbvhType23_;
    var v34_1: LightbvhType23_;
    var v35_1: LightbvhType23_;
    var v36_1: LightbvhType23_;
    var v37_1: LightbvhType23_;
    var v38_1: bool;
    var v39_1: u32;
    var v40_1: u32;
    var v41_1: u32;
    var v42_1: u32;
    var v43_1: i32;
    var v44_1: u32;
    var v45_1: bool;
    var v46_1: LightbvhType26_;
    var v47_1: u32;
    var v48_1: u32;
    var v49_1: LightbvhType26_;
    var v50_1: f32;
    var v51_1: f32;
    var v52_1: f32;
    var v53_1: f32;
    var v54_1: LightbvhType26_;
    var v55_1: bool;
    var v56_1: LightbvhType26_;
    var v57_1: bool;
    var v58_1: bool;
    var v59_1: LightbvhType26_;
    var v60_1: LightbvhType26_;
    var v61_1: LightbvhType26_;
    var v62_1: LightbvhType26_;
    var v63_1: f32;
    var v64_1: u32;
    var v65_1: u32;
    var v66_1: bool;
    var v67_1: u32;
    var v68_1: i32;
    var v69_1: u32;
    var v70_1: i32;
    var v71_1: u32;
    var v72_1: u32;
    var v73_1: u32;
    var v74_1: u32;
    var v75_1: bool;
    var v76_1: u32;
    var v77_1: i32;
    var v78_1: u32;
    var v79_1: i32;
    var v80_1: u32;
    var v81_1: u32;
    var v82_1: u32;
    var v83_1: u32;
    var v84_1: bool;
    var v85_1: bool;
    var v86_1: bool;
    var v87_1: bool;
    var v88_1: f32;

    queries_1 = LightbvhType16_(LightbvhType14_(array<f32, 3>(p_1.x, p_1.y, p_1.z), array<f32, 3>(n_1.x, n_1.y, n_1.z)), array<u32, 2>(light, instance));
    switch bitcast<i32>(0u) {
        default: {
            let _e135 = arrayLength((&lightbvh_nodes.list));
            let _e138 = arrayLength((&lightbvh_instances.list));
            let _e141 = arrayLength((&lightbvh_trails.list));
            let _e144 = lightbvh_tree.top;
            let _e147 = lightbvh_tree.root;
            let _e150 = lightbvh_tree.above;
            let _e153 = lightbvh_tree.places;
            let _e156 = lightbvh_tree.parts;
            let _e159 = lightbvh_tree.trail_words;
            let _e162 = lightbvh_tree.live;
            let _e165 = lightbvh_tree.lights;
            let _e168 = lightbvh_tree.depth;
            let _e170 = queries_1;
            let _e176 = (_e162 > 0u);
            let _e177 = select(4294967295u, _e170.member_1[1], _e176);
            let _e178 = (_e177 < _e138);
            v2_1 = u32();
            v3_1 = true;
            if _e178 {
                v1_1 = u32();
                if _e176 {
                    if _e178 {
                    } else {
                        break;
                    }
                    let _e181 = lightbvh_instances.list[_e177].first;
                    let _e185 = lightbvh_instances.list[_e177].first_light;
                    v1_1 = ((_e170.member_1[0] - _e181) + _e185);
                }
                let _e188 = v1_1;
                v2_1 = _e188;
                v3_1 = select(true, false, _e176);
            }
            let _e191 = v2_1;
            let _e193 = v3_1;
            let _e194 = select(_e191, _e170.member_1[0], _e193);
            let _e195 = (_e194 * _e159);
            let _e196 = (_e195 < _e141);
            v4_1 = 0u;
            if _e196 {
                if _e196 {
                } else {
                    break;
                }
                let _e198 = lightbvh_trails.list[_e195];
                v4_1 = _e198;
            }
            let _e200 = v4_1;
            v6_1 = u32();
            v7_1 = true;
            if (_e159 == 2u) {
                let _e202 = (_e195 + 1u);
                let _e203 = (_e202 < _e141);
                v5_1 = u32();
                if _e203 {
                    if _e203 {
                    } else {
                        break;
                    }
                    let _e205 = lightbvh_trails.list[_e202];
                    v5_1 = _e205;
                }
                let _e207 = v5_1;
                v6_1 = _e207;
                v7_1 = select(true, false, _e203);
            }
            let _e210 = v6_1;
            let _e212 = v7_1;
            let _e213 = select(_e210, 0u, _e212);
            v8_1 = bool();
            v9_1 = LightbvhType24_();
            if _e178 {
                let _e220 = (_e153 + _e177);
                let _e221 = (_e220 < _e141);
                v10_1 = 4294967295u;
                if _e221 {
                    if _e221 {
                    } else {
                        break;
                    }
                    let _e223 = lightbvh_trails.list[_e220];
                    v10_1 = _e223;
                }
                let _e225 = v10_1;
                v13_1 = u32();
                v14_1 = true;
                if (_e225 != 4294967295u) {
                    let _e227 = (_e225 >= 2147483648u);
                    v12_1 = u32();
                    if _e227 {
                        let _e231 = (_e156 + ((_e225 - 2147483648u) + (_e200 & 7u)));
                        let _e232 = (_e231 < _e141);
                        v11_1 = 4294967295u;
                        if _e232 {
                            if _e232 {
                            } else {
                                break;
                            }
                            let _e234 = lightbvh_trails.list[_e231];
                            v11_1 = _e234;
                        }
                        let _e236 = v11_1;
                        v12_1 = _e236;
                    }
                    let _e238 = v12_1;
                    v13_1 = _e238;
                    v14_1 = select(true, false, _e227);
                }
                let _e241 = v13_1;
                let _e243 = v14_1;
                v15_1 = 0u;
                v16_1 = LightbvhType23_(0u, 0u);
                v17_1 = select(_e241, _e225, _e243);
                loop {
                    let _e246 = v15_1;
                    let _e248 = v16_1;
                    let _e250 = v17_1;
                    v27_1 = _e248;
                    v22_1 = u32();
                    v23_1 = LightbvhType23_();
                    v24_1 = u32();
                    v25_1 = false;
                    if (_e250 < 2147483648u) {
                        let _e252 = (_e246 < 20u);
                        v19_1 = u32();
                        v20_1 = LightbvhType23_();
                        v21_1 = u32();
                        if _e252 {
                            let _e271 = (_e150 + (_e250 >> bitcast<u32>(3u)));
                            let _e272 = (_e271 < _e141);
                            v18_1 = 4294967295u;
                            if _e272 {
                                if _e272 {
                                } else {
                                    v26_1 = true;
                                    break;
                                }
                                let _e274 = lightbvh_trails.list[_e271];
                                v18_1 = _e274;
                            }
                            let _e276 = v18_1;
                            v19_1 = (_e246 + 1u);
                            v20_1 = LightbvhType23_((((_e248.member << bitcast<u32>(3u)) | ((_e250 & 7u) & 7u)) & 1073741823u), (((_e248.member_1 << bitcast<u32>(3u)) | ((_e248.member >> bitcast<u32>(27u)) & 7u)) & 1073741823u));
                            v21_1 = _e276;
                        }
                        let _e279 = v19_1;
                        let _e281 = v20_1;
                        let _e283 = v21_1;
                        v22_1 = _e279;
                        v23_1 = _e281;
                        v24_1 = _e283;
                        v25_1 = _e252;
                    }
                    let _e285 = v22_1;
                    let _e287 = v23_1;
                    let _e289 = v24_1;
                    let _e291 = v25_1;
                    continue;
                    continuing {
                        v15_1 = _e285;
                        v16_1 = _e287;
                        v17_1 = _e289;
                        v26_1 = false;
                        break if !(_e291);
                    }
                }
                let _e294 = v26_1;
                if _e294 {
                    break;
                }
                let _e297 = v27_1;
                v8_1 = _e294;
                v9_1 = LightbvhType24_(_e297, LightbvhType23_(_e200, _e213));
            }
            let _e215 = v8_1;
            let _e217 = v9_1;
            v28_1 = _e215;
            v29_1 = _e217;
            if _e178 {
            } else {
                v28_1 = false;
                v29_1 = LightbvhType24_(LightbvhType23_(_e200, _e213), LightbvhType23_(0u, 0u));
            }
            let _e300 = v28_1;
            let _e302 = v29_1;
            let _e304 = (_e168 == 0u);
            let _e305 = LightbvhType26_(_e302, LightbvhType23_(0u, 0u), _e170.member, LightbvhType25_(0f, 1f), 0u, (_e147 + _e144), 4294967295u, 4294967295u, 0u, 4194304u, 0u, _e168, _e304, true);
            let _e308 = (bitcast<u32>(21i) - firstLeadingBit(4128767u));
            let _e310 = select(22u, _e308, (_e308 < 22u));
            let _e311 = (_e310 & 31u);
            let _e329 = LightbvhType26_(_e305.member, LightbvhType23_((4227858432u << bitcast<u32>(_e311)), 0u), _e305.member_2, _e305.member_3, _e305.member_4, _e305.member_5, _e305.member_6, _e305.member_7, _e305.member_8, _e305.member_9, _e305.member_10, _e305.member_11, _e305.member_12, _e305.member_13);
            let _e346 = LightbvhType26_(_e329.member, _e329.member_1, _e329.member_2, _e329.member_3, _e329.member_4, _e329.member_5, _e329.member_6, _e329.member_7, _e329.member_8, (4128768u << bitcast<u32>(_e311)), _e329.member_10, _e329.member_11, _e329.member_12, _e329.member_13);
            v30_1 = _e300;
            v31_1 = LightbvhType26_(_e346.member, _e346.member_1, _e346.member_2, _e346.member_3, _e346.member_4, _e346.member_5, _e346.member_6, _e346.member_7, _e346.member_8, _e346.member_9, _e310, _e346.member_11, _e346.member_12, _e346.member_13);
            v32_1 = _e304;
            loop {
                let _e363 = v30_1;
                let _e365 = v31_1;
                let _e367 = v32_1;
                v59_1 = _e365;
                v60_1 = _e365;
                v61_1 = _e365;
                v62_1 = _e365;
                v55_1 = _e363;
                v56_1 = LightbvhType26_();
                v57_1 = bool();
                if _e367 {
                } else {
                    let _e369 = (_e365.member_5 < _e135);
                    let _e370 = select(0u, _e365.member_5, _e369);
                    if (_e370 < _e135) {
                    } else {
                        v58_1 = true;
                        break;
                    }
                    let _e393 = lightbvh_nodes.list[_e370][0u][3u];
                    let _e396 = (bitcast<i32>((_e393 & 255u)) - 127i);
                    let _e407 = lightbvh_nodes.list[_e370][0u][0u];
                    let _e412 = lightbvh_nodes.list[_e370][0u][1u];
                    let _e417 = lightbvh_nodes.list[_e370][0u][2u];
                    let _e419 = (bitcast<f32>(_e407) - _e365.member_2.member[0]);
                    let _e420 = (bitcast<f32>(_e412) - _e365.member_2.member[1]);
                    let _e421 = (bitcast<f32>(_e417) - _e365.member_2.member[2]);
                    let _e424 = bitcast<f32>((bitcast<u32>(_e419) & 2147483647u));
                    let _e427 = bitcast<f32>((bitcast<u32>(_e420) & 2147483647u));
                    let _e430 = bitcast<f32>((bitcast<u32>(_e421) & 2147483647u));
                    let _e432 = select(_e427, _e424, (_e424 > _e427));
                    let _e440 = (bitcast<i32>(((bitcast<u32>(select(_e430, _e432, (_e432 > _e430))) >> bitcast<u32>(23i)) & 255u)) - 127i);
                    let _e442 = select(_e396, _e440, (_e440 > _e396));
                    let _e443 = (_e396 - _e442);
                    let _e445 = select(_e443, -40i, (_e443 < -40i));
                    let _e446 = -(_e442);
                    let _e448 = select(_e446, -126i, (_e446 < -126i));
                    let _e455 = bitcast<f32>((bitcast<u32>((select(_e448, 127i, (_e448 > 127i)) + 127i)) << bitcast<u32>(23i)));
                    let _e460 = select(_e445, -126i, (_e445 < -126i));
                    let _e467 = bitcast<f32>((bitcast<u32>((select(_e460, 127i, (_e460 > 127i)) + 127i)) << bitcast<u32>(23i)));
                    let _e468 = (_e467 * 0.0000000004656613f);
                    let _e480 = (2f * 8f);
                    let _e481 = (bitcast<f32>((bitcast<u32>(_e365.member_2.member_1[0]) & 2147483647u)) * _e480);
                    let _e482 = (bitcast<f32>((bitcast<u32>(_e365.member_2.member_1[1]) & 2147483647u)) * _e480);
                    let _e483 = (bitcast<f32>((bitcast<u32>(_e365.member_2.member_1[2]) & 2147483647u)) * _e480);
                    v0_1 = array<f32, 8>(0f, 0f, 0f, 0f, 0f, 0f, 0f, 0f);
                    v33_1 = LightbvhType23_(0u, 8u);
                    loop {
                        let _e490 = v33_1;
                        let _e493 = (_e490.member < _e490.member_1);
                        v34_1 = LightbvhType23_();
                        v35_1 = LightbvhType23_();
                        if _e493 {
                            v34_1 = LightbvhType23_((_e490.member + 1u), _e490.member_1);
                            v35_1 = LightbvhType23_(1u, _e490.member);
                        }
                        let _e495 = v34_1;
                        let _e497 = v35_1;
                        v36_1 = _e495;
                        v37_1 = _e497;
                        if _e493 {
                        } else {
                            v36_1 = _e490;
                            v37_1 = LightbvhType23_(0u, LightbvhType23_().member_1);
                        }
                        let _e507 = v36_1;
                        let _e509 = v37_1;
                        let _e513 = (bitcast<i32>(_e509.member) != 0i);
                        if _e513 {
                            let _e514 = (_e509.member_1 < 8u);
                            if _e514 {
                            } else {
                                v38_1 = true;
                                break;
                            }
                            let _e518 = lightbvh_nodes.list[_e370][1u][_e509.member_1];
                            if _e514 {
                            } else {
                                v38_1 = true;
                                break;
                            }
                            let _e522 = lightbvh_nodes.list[_e370][2u][_e509.member_1];
                            if _e514 {
                            } else {
                                v38_1 = true;
                                break;
                            }
                            let _e526 = lightbvh_nodes.list[_e370][3u][_e509.member_1];
                            if _e514 {
                            } else {
                                v38_1 = true;
                                break;
                            }
                            let _e530 = lightbvh_nodes.list[_e370][4u][_e509.member_1];
                            let _e546 = ((_e419 * _e455) + (f32(bitcast<i32>(_e518)) * _e468));
                            let _e547 = ((_e420 * _e455) + (f32(bitcast<i32>((_e518 << bitcast<u32>(15u)))) * _e468));
                            let _e548 = ((_e421 * _e455) + (f32(bitcast<i32>(_e522)) * _e468));
                            let _e553 = bitcast<f32>((((_e530 << bitcast<u32>(20u)) & 267386880u) + (bitcast<u32>(_e467) + 4043309056u)));
                            let _e558 = (f32(bitcast<i32>((_e522 << bitcast<u32>(15u)))) * 0.0000000004656613f);
                            let _e560 = f32(bitcast<i32>(_e526));
                            let _e564 = f32(bitcast<i32>((_e526 << bitcast<u32>(8u))));
                            let _e568 = f32(bitcast<i32>((_e526 << bitcast<u32>(16u))));
                            let _e572 = (f32(bitcast<i32>((_e526 & 255u))) * 0.003921569f);
                            let _e589 = (_e553 * _e553);
                            let _e595 = ((((_e546 * _e546) + (_e547 * _e547)) + (_e548 * _e548)) + 0.0000000000000008881784f);
                            let _e599 = (_e595 + (1.25f * _e589));
                            let _e604 = bitcast<f32>((1595932665u - (bitcast<u32>(_e599) >> bitcast<u32>(1i))));
                            let _e609 = (_e604 * (0.70395225f * (2.3892446f - (_e599 * (_e604 * _e604)))));
                            let _e610 = (_e553 * _e609);
                            let _e615 = ((((_e365.member_2.member_1[0] * 0.0000000004656613f) * _e560) + ((_e365.member_2.member_1[1] * 0.0000000004656613f) * _e564)) + ((_e365.member_2.member_1[2] * 0.0000000004656613f) * _e568));
                            let _e620 = (0.03162278f + (_e610 * (1f + (_e558 * (_e615 * _e615)))));
                            let _e626 = (((((_e365.member_2.member_1[0] + _e365.member_2.member_1[0]) * _e546) + ((_e365.member_2.member_1[1] + _e365.member_2.member_1[1]) * _e547)) + ((_e365.member_2.member_1[2] + _e365.member_2.member_1[2]) * _e548)) * _e609);
                            let _e628 = (_e626 + ((((_e481 + _e482) + _e483) + ((((_e481 * 0.0000000004656613f) * f32(bitcast<i32>(_e530))) + ((_e482 * 0.0000000004656613f) * f32(bitcast<i32>((_e530 << bitcast<u32>(8u)))))) + ((_e483 * 0.0000000004656613f) * f32(bitcast<i32>((_e530 << bitcast<u32>(16u))))))) * _e610));
                            let _e630 = select(0.0001f, _e628, (_e628 > 0.0001f));
                            let _e636 = (bitcast<f32>((bitcast<u32>(_e626) & 2147483647u)) + _e620);
                            let _e642 = (1f + _e558);
                            let _e648 = ((((_e560 * _e546) + (_e564 * _e547)) + (_e568 * _e548)) * (-2f * 0.0000000004656613f));
                            let _e651 = (_e553 * select(_e572, _e642, (_e642 > _e572)));
                            let _e653 = (_e595 - (2.5f * _e589));
                            let _e655 = (0.25f * (_e648 * _e648));
                            let _e661 = ((select(_e655, _e653, (_e653 > _e655)) + 0.0000000000000008881784f) + (1.25f * (_e651 * _e651)));
                            let _e666 = bitcast<f32>((1595932665u - (bitcast<u32>(_e661) >> bitcast<u32>(1i))));
                            let _e671 = (_e666 * (0.70395225f * (2.3892446f - (_e661 * (_e666 * _e666)))));
                            let _e673 = ((_e553 * _e671) * _e642);
                            let _e677 = ((0.03162278f + _e673) + (_e572 * (0.5f - _e673)));
                            let _e678 = (_e648 * _e671);
                            let _e682 = (bitcast<f32>((bitcast<u32>(_e678) & 2147483647u)) + _e677);
                            let _e691 = ((_e636 * _e682) * (_e595 + (0.5f * _e589)));
                            let _e694 = bitcast<f32>((2129859015u - bitcast<u32>(_e691)));
                            if _e514 {
                            } else {
                                v38_1 = true;
                                break;
                            }
                            v0_1[_e509.member_1] = ((bitcast<f32>(((_e522 & 2047u) << bitcast<u32>(19u))) * (((select(0f, _e626, (_e626 > 0f)) * _e636) + (_e620 * select(_e620, _e630, (_e630 < _e620)))) * ((select(0f, _e678, (_e678 > 0f)) * _e682) + (_e677 * _e677)))) * (_e694 * (2f - (_e691 * _e694))));
                        }
                        continue;
                        continuing {
                            v33_1 = _e507;
                            v38_1 = _e363;
                            break if !(_e513);
                        }
                    }
                    let _e702 = v38_1;
                    v58_1 = _e702;
                    if _e702 {
                        break;
                    }
                    let _e703 = v0_1;
                    let _e720 = (_e365.member_8 < 20u);
                    v39_1 = u32();
                    if _e720 {
                        let _e743 = (_e365.member_8 < 10u);
                        v41_1 = _e365.member_8;
                        if _e743 {
                        } else {
                            v41_1 = (_e365.member_8 - 10u);
                        }
                        let _e746 = v41_1;
                        v39_1 = ((select(_e365.member.member.member_1, _e365.member.member.member, _e743) >> bitcast<u32>((((_e746 * 3u) & 31u) & 31u))) & 7u);
                    }
                    let _e722 = v39_1;
                    v42_1 = _e722;
                    if _e720 {
                    } else {
                        let _e727 = (_e365.member_8 - 20u);
                        let _e728 = (_e727 < 10u);
                        v40_1 = _e727;
                        if _e728 {
                        } else {
                            v40_1 = (_e365.member_8 - 30u);
                        }
                        let _e731 = v40_1;
                        v42_1 = ((select(_e365.member.member_1.member_1, _e365.member.member_1.member, _e728) >> bitcast<u32>((((_e731 * 3u) & 31u) & 31u))) & 7u);
                    }
                    let _e755 = v42_1;
                    let _e760 = (0u - select(0u, 1u, (_e703[1] > 0f)));
                    let _e761 = (1u & _e760);
                    let _e765 = (0u - select(0u, 1u, (_e703[2] > 0f)));
                    let _e768 = (_e761 ^ ((2u ^ _e761) & _e765));
                    let _e772 = (0u - select(0u, 1u, (_e703[3] > 0f)));
                    let _e775 = (_e768 ^ ((3u ^ _e768) & _e772));
                    let _e779 = (0u - select(0u, 1u, (_e703[4] > 0f)));
                    let _e782 = (_e775 ^ ((4u ^ _e775) & _e779));
                    let _e786 = (0u - select(0u, 1u, (_e703[5] > 0f)));
                    let _e789 = (_e782 ^ ((5u ^ _e782) & _e786));
                    let _e793 = (0u - select(0u, 1u, (_e703[6] > 0f)));
                    let _e796 = (_e789 ^ ((6u ^ _e789) & _e793));
                    let _e800 = (0u - select(0u, 1u, (_e703[7] > 0f)));
                    let _e803 = (_e796 ^ ((7u ^ _e796) & _e800));
                    let _e806 = ((((0f + _e703[0]) + _e703[4]) + ((0f + _e703[2]) + _e703[6])) + (((0f + _e703[1]) + _e703[5]) + ((0f + _e703[3]) + _e703[7])));
                    let _e807 = (_e806 > 0f);
                    let _e811 = select(1f, _e806, _e807);
                    let _e812 = bitcast<u32>(_e811);
                    let _e817 = bitcast<f32>(((_e812 & 2147483648u) | (2129859015u - (_e812 & 2147483647u))));
                    let _e820 = (_e817 * (2f - (_e811 * _e817)));
                    let _e824 = ((f32(bitcast<i32>(_e365.member_9)) * 0.9999695f) * (_e820 * (2f - (_e811 * _e820))));
                    v43_1 = 2147483647i;
                    if _e365.member_13 {
                    } else {
                        v43_1 = bitcast<i32>((_e365.member_1.member >> bitcast<u32>(10u)));
                    }
                    let _e827 = v43_1;
                    let _e833 = bitcast<i32>((bitcast<u32>(((_e703[0] * _e824) + 8388608f)) & 8388607u));
                    let _e840 = (select(1i, _e833, (_e833 > 1i)) & bitcast<i32>((0u - select(0u, 1u, (_e703[0] > 0f)))));
                    let _e841 = bitcast<u32>(_e840);
                    let _e842 = (_e841 & 4294967295u);
                    let _e844 = bitcast<i32>(select(_e803, _e755, _e365.member_13));
                    let _e848 = (0u - select(0u, 1u, ((_e840 <= _e827) && (0i < _e844))));
                    let _e849 = (_e841 & _e848);
                    let _e855 = bitcast<i32>((bitcast<u32>(((_e703[1] * _e824) + 8388608f)) & 8388607u));
                    let _e860 = (_e840 + (select(1i, _e855, (_e855 > 1i)) & bitcast<i32>(_e760)));
                    let _e861 = bitcast<u32>(_e860);
                    let _e864 = (_e842 ^ ((_e861 ^ _e842) & _e848));
                    let _e869 = (0u - select(0u, 1u, ((_e860 <= _e827) && (1i < _e844))));
                    let _e872 = (_e849 ^ ((_e861 ^ _e849) & _e869));
                    let _e879 = bitcast<i32>((bitcast<u32>(((_e703[2] * _e824) + 8388608f)) & 8388607u));
                    let _e884 = (_e860 + (select(1i, _e879, (_e879 > 1i)) & bitcast<i32>(_e765)));
                    let _e885 = bitcast<u32>(_e884);
                    let _e888 = (_e864 ^ ((_e885 ^ _e864) & _e869));
                    let _e893 = (0u - select(0u, 1u, ((_e884 <= _e827) && (2i < _e844))));
                    let _e896 = (_e872 ^ ((_e885 ^ _e872) & _e893));
                    let _e903 = bitcast<i32>((bitcast<u32>(((_e703[3] * _e824) + 8388608f)) & 8388607u));
                    let _e908 = (_e884 + (select(1i, _e903, (_e903 > 1i)) & bitcast<i32>(_e772)));
                    let _e909 = bitcast<u32>(_e908);
                    let _e912 = (_e888 ^ ((_e909 ^ _e888) & _e893));
                    let _e917 = (0u - select(0u, 1u, ((_e908 <= _e827) && (3i < _e844))));
                    let _e920 = (_e896 ^ ((_e909 ^ _e896) & _e917));
                    let _e927 = bitcast<i32>((bitcast<u32>(((_e703[4] * _e824) + 8388608f)) & 8388607u));
                    let _e932 = (_e908 + (select(1i, _e927, (_e927 > 1i)) & bitcast<i32>(_e779)));
                    let _e933 = bitcast<u32>(_e932);
                    let _e936 = (_e912 ^ ((_e933 ^ _e912) & _e917));
                    let _e941 = (0u - select(0u, 1u, ((_e932 <= _e827) && (4i < _e844))));
                    let _e944 = (_e920 ^ ((_e933 ^ _e920) & _e941));
                    let _e951 = bitcast<i32>((bitcast<u32>(((_e703[5] * _e824) + 8388608f)) & 8388607u));
                    let _e956 = (_e932 + (select(1i, _e951, (_e951 > 1i)) & bitcast<i32>(_e786)));
                    let _e957 = bitcast<u32>(_e956);
                    let _e960 = (_e936 ^ ((_e957 ^ _e936) & _e941));
                    let _e965 = (0u - select(0u, 1u, ((_e956 <= _e827) && (5i < _e844))));
                    let _e968 = (_e944 ^ ((_e957 ^ _e944) & _e965));
                    let _e975 = bitcast<i32>((bitcast<u32>(((_e703[6] * _e824) + 8388608f)) & 8388607u));
                    let _e980 = (_e956 + (select(1i, _e975, (_e975 > 1i)) & bitcast<i32>(_e793)));
                    let _e981 = bitcast<u32>(_e980);
                    let _e984 = (_e960 ^ ((_e981 ^ _e960) & _e965));
                    let _e989 = (0u - select(0u, 1u, ((_e980 <= _e827) && (6i < _e844))));
                    let _e992 = (_e968 ^ ((_e981 ^ _e968) & _e989));
                    let _e999 = bitcast<i32>((bitcast<u32>(((_e703[7] * _e824) + 8388608f)) & 8388607u));
                    let _e1004 = (_e980 + (select(1i, _e999, (_e999 > 1i)) & bitcast<i32>(_e800)));
                    let _e1005 = bitcast<u32>(_e1004);
                    let _e1008 = (_e984 ^ ((_e1005 ^ _e984) & _e989));
                    let _e1013 = (0u - select(0u, 1u, ((_e1004 <= _e827) && (7i < _e844))));
                    let _e1016 = (_e992 ^ ((_e1005 ^ _e992) & _e1013));
                    let _e1019 = select(((((((((_e848 & 1u) + (_e869 & 1u)) + (_e893 & 1u)) + (_e917 & 1u)) + (_e941 & 1u)) + (_e965 & 1u)) + (_e989 & 1u)) + (_e1013 & 1u)), _e755, _e365.member_13);
                    let _e1024 = (_e1019 < 8u);
                    let _e1025 = ((_e807 && (_e1008 > _e1016)) && _e1024);
                    let _e1026 = select(0u, _e1019, _e1024);
                    v44_1 = 0u;
                    if _e1025 {
                        v44_1 = (select(_e1008, _e365.member_9, (_e1019 == _e803)) - _e1016);
                    }
                    let _e1030 = v44_1;
                    let _e1031 = (_e1026 < 8u);
                    if _e1031 {
                    } else {
                        v58_1 = true;
                        break;
                    }
                    let _e1035 = lightbvh_nodes.list[_e370][1u][_e1026];
                    let _e1036 = (_e1035 & 3u);
                    if _e1031 {
                    } else {
                        v58_1 = true;
                        break;
                    }
                    let _e1040 = lightbvh_nodes.list[_e370][5u][_e1026];
                    let _e1044 = ((_e369 && (_e1030 > 0u)) && (_e1030 <= _e365.member_9));
                    let _e1045 = select(1u, _e1030, _e1044);
                    let _e1047 = ((_e1045 - 1u) & 4194303u);
                    let _e1053 = (select((bitcast<u32>(31i) - firstLeadingBit(_e1047)), 32u, (_e1047 == 0u)) - 10u);
                    let _e1055 = select(22u, _e1053, (_e1053 < 22u));
                    let _e1067 = (_e1055 & 31u);
                    let _e1088 = LightbvhType26_(_e365.member, LightbvhType23_((((_e365.member_1.member - (select(0u, _e1016, _e1025) << bitcast<u32>(10u))) << bitcast<u32>(_e1067)) | ((_e365.member_1.member_1 >> bitcast<u32>(1i)) >> bitcast<u32>(((31u - _e1055) & 31u)))), (_e365.member_1.member_1 << bitcast<u32>(_e1067))), _e365.member_2, _e365.member_3, _e365.member_4, _e365.member_5, _e365.member_6, _e365.member_7, _e365.member_8, _e365.member_9, _e365.member_10, _e365.member_11, _e365.member_12, _e365.member_13);
                    let _e1105 = LightbvhType26_(_e1088.member, _e1088.member_1, _e1088.member_2, _e1088.member_3, _e1088.member_4, _e1088.member_5, _e1088.member_6, _e1088.member_7, _e1088.member_8, (_e1045 << bitcast<u32>(_e1067)), _e1088.member_10, _e1088.member_11, _e1088.member_12, _e1088.member_13);
                    let _e1122 = LightbvhType26_(_e1105.member, _e1105.member_1, _e1105.member_2, _e1105.member_3, _e1105.member_4, _e1105.member_5, _e1105.member_6, _e1105.member_7, _e1105.member_8, _e1105.member_9, (_e365.member_10 + _e1055), _e1105.member_11, _e1105.member_12, _e1105.member_13);
                    let _e1123 = (_e365.member_8 + 1u);
                    v45_1 = true;
                    if (_e1123 == 20u) {
                    } else {
                        v45_1 = (_e1123 == 40u);
                    }
                    let _e1127 = v45_1;
                    let _e1128 = (_e1040 & 134217727u);
                    let _e1132 = (_e1040 >> bitcast<u32>((firstTrailingBit(134217728u) & 31u)));
                    let _e1136 = (_e1128 < _e138);
                    let _e1137 = (((_e1044 && (_e1036 == 3u)) && _e720) && _e1136);
                    let _e1141 = ((_e1044 && (_e1036 == 1u)) && !(_e1127));
                    let _e1159 = LightbvhType26_(_e1122.member, _e1122.member_1, _e1122.member_2, _e1122.member_3, _e1122.member_4, _e1122.member_5, select(4294967295u, _e1040, (_e1044 && (_e1036 == 2u))), _e1122.member_7, _e1122.member_8, _e1122.member_9, _e1122.member_10, _e1122.member_11, _e1122.member_12, _e1122.member_13);
                    let _e1161 = (_e365.member_11 - 1u);
                    let _e1176 = LightbvhType26_(_e1159.member, _e1159.member_1, _e1159.member_2, _e1159.member_3, _e1159.member_4, _e1159.member_5, _e1159.member_6, _e1159.member_7, _e1159.member_8, _e1159.member_9, _e1159.member_10, _e1161, _e1159.member_12, _e1159.member_13);
                    let _e1180 = (!((_e1137 || _e1141)) || (_e1161 == 0u));
                    let _e1195 = LightbvhType26_(_e1176.member, _e1176.member_1, _e1176.member_2, _e1176.member_3, _e1176.member_4, _e1176.member_5, _e1176.member_6, _e1176.member_7, _e1176.member_8, _e1176.member_9, _e1176.member_10, _e1176.member_11, _e1180, _e1176.member_13);
                    v46_1 = LightbvhType26_();
                    if _e1137 {
                        if _e1136 {
                        } else {
                            v58_1 = true;
                            break;
                        }
                        let _e1248 = LightbvhType26_(_e1195.member, _e1195.member_1, _e1195.member_2, _e1195.member_3, _e1195.member_4, _e1195.member_5, _e1195.member_6, _e1128, _e1195.member_8, _e1195.member_9, _e1195.member_10, _e1195.member_11, _e1195.member_12, _e1195.member_13);
                        let _e1251 = lightbvh_instances.list[_e1128].root;
                        let _e1266 = LightbvhType26_(_e1248.member, _e1248.member_1, _e1248.member_2, _e1248.member_3, _e1248.member_4, _e1251, _e1248.member_6, _e1248.member_7, _e1248.member_8, _e1248.member_9, _e1248.member_10, _e1248.member_11, _e1248.member_12, _e1248.member_13);
                        let _e1267 = (_e1251 == 4294967295u);
                        v48_1 = 4294967295u;
                        if _e1267 {
                            let _e1270 = lightbvh_instances.list[_e1128].first_light;
                            v48_1 = _e1270;
                        }
                        let _e1272 = v48_1;
                        let _e1287 = LightbvhType26_(_e1266.member, _e1266.member_1, _e1266.member_2, _e1266.member_3, _e1266.member_4, _e1266.member_5, _e1272, _e1266.member_7, _e1266.member_8, _e1266.member_9, _e1266.member_10, _e1266.member_11, _e1266.member_12, _e1266.member_13);
                        let _e1288 = (_e1180 || _e1267);
                        let _e1303 = LightbvhType26_(_e1287.member, _e1287.member_1, _e1287.member_2, _e1287.member_3, _e1287.member_4, _e1287.member_5, _e1287.member_6, _e1287.member_7, _e1287.member_8, _e1287.member_9, _e1287.member_10, _e1287.member_11, _e1288, _e1287.member_13);
                        let _e1318 = LightbvhType26_(_e1303.member, _e1303.member_1, _e1303.member_2, _e1303.member_3, _e1303.member_4, _e1303.member_5, _e1303.member_6, _e1303.member_7, 20u, _e1303.member_9, _e1303.member_10, _e1303.member_11, _e1303.member_12, _e1303.member_13);
                        v49_1 = _e1318;
                        if (_e1132 > 0u) {
                            let _e1321 = select(0u, _e1251, (_e1251 < _e135));
                            if (_e1321 < _e135) {
                            } else {
                                v58_1 = true;
                                break;
                            }
                            let _e1324 = ((_e1132 - 1u) % 8u);
                            let _e1325 = (_e1324 < 8u);
                            if _e1325 {
                            } else {
                                v58_1 = true;
                                break;
                            }
                            let _e1329 = lightbvh_nodes.list[_e1321][1u][_e1324];
                            let _e1330 = (_e1329 & 3u);
                            if _e1325 {
                            } else {
                                v58_1 = true;
                                break;
                            }
                            let _e1334 = lightbvh_nodes.list[_e1321][5u][_e1324];
                            let _e1349 = LightbvhType26_(_e1318.member, _e1318.member_1, _e1318.member_2, _e1318.member_3, _e1318.member_4, _e1334, _e1318.member_6, _e1318.member_7, _e1318.member_8, _e1318.member_9, _e1318.member_10, _e1318.member_11, _e1318.member_12, _e1318.member_13);
                            let _e1366 = LightbvhType26_(_e1349.member, _e1349.member_1, _e1349.member_2, _e1349.member_3, _e1349.member_4, _e1349.member_5, select(4294967295u, _e1334, (_e1330 == 2u)), _e1349.member_7, _e1349.member_8, _e1349.member_9, _e1349.member_10, _e1349.member_11, _e1349.member_12, _e1349.member_13);
                            let _e1383 = LightbvhType26_(_e1366.member, _e1366.member_1, _e1366.member_2, _e1366.member_3, _e1366.member_4, _e1366.member_5, _e1366.member_6, _e1366.member_7, _e1366.member_8, _e1366.member_9, _e1366.member_10, _e1366.member_11, (_e1288 || (_e1330 != 1u)), _e1366.member_13);
                            v49_1 = LightbvhType26_(_e1383.member, _e1383.member_1, _e1383.member_2, _e1383.member_3, _e1383.member_4, _e1383.member_5, _e1383.member_6, _e1383.member_7, 21u, _e1383.member_9, _e1383.member_10, _e1383.member_11, _e1383.member_12, _e1383.member_13);
                        }
                        let _e1400 = v49_1;
                        let _e1410 = lightbvh_instances.list[_e1128].translation[0u];
                        let _e1414 = lightbvh_instances.list[_e1128].translation[1u];
                        let _e1418 = lightbvh_instances.list[_e1128].translation[2u];
                        let _e1419 = (_e170.member.member[0] - _e1410);
                        let _e1420 = (_e170.member.member[1] - _e1414);
                        let _e1421 = (_e170.member.member[2] - _e1418);
                        let _e1426 = select(_e1419, 0f, (bitcast<f32>((bitcast<u32>(_e1419) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1431 = select(_e1420, 0f, (bitcast<f32>((bitcast<u32>(_e1420) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1436 = select(_e1421, 0f, (bitcast<f32>((bitcast<u32>(_e1421) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1441 = lightbvh_instances.list[_e1128].inverse[0u][0u];
                        let _e1446 = lightbvh_instances.list[_e1128].inverse[0u][1u];
                        let _e1451 = lightbvh_instances.list[_e1128].inverse[0u][2u];
                        let _e1459 = lightbvh_instances.list[_e1128].inverse[1u][0u];
                        let _e1464 = lightbvh_instances.list[_e1128].inverse[1u][1u];
                        let _e1469 = lightbvh_instances.list[_e1128].inverse[1u][2u];
                        let _e1480 = lightbvh_instances.list[_e1128].inverse[2u][0u];
                        let _e1485 = lightbvh_instances.list[_e1128].inverse[2u][1u];
                        let _e1490 = lightbvh_instances.list[_e1128].inverse[2u][2u];
                        let _e1494 = (((_e1441 * _e1426) + (_e1459 * _e1431)) + (_e1480 * _e1436));
                        let _e1495 = (((_e1446 * _e1426) + (_e1464 * _e1431)) + (_e1485 * _e1436));
                        let _e1496 = (((_e1451 * _e1426) + (_e1469 * _e1431)) + (_e1490 * _e1436));
                        let _e1507 = lightbvh_instances.list[_e1128].columns[0u][0u];
                        let _e1512 = lightbvh_instances.list[_e1128].columns[0u][1u];
                        let _e1517 = lightbvh_instances.list[_e1128].columns[0u][2u];
                        let _e1522 = (((_e1507 * _e170.member.member_1[0]) + (_e1512 * _e170.member.member_1[1])) + (_e1517 * _e170.member.member_1[2]));
                        let _e1527 = lightbvh_instances.list[_e1128].columns[1u][0u];
                        let _e1532 = lightbvh_instances.list[_e1128].columns[1u][1u];
                        let _e1537 = lightbvh_instances.list[_e1128].columns[1u][2u];
                        let _e1542 = (((_e1527 * _e170.member.member_1[0]) + (_e1532 * _e170.member.member_1[1])) + (_e1537 * _e170.member.member_1[2]));
                        let _e1547 = lightbvh_instances.list[_e1128].columns[2u][0u];
                        let _e1552 = lightbvh_instances.list[_e1128].columns[2u][1u];
                        let _e1557 = lightbvh_instances.list[_e1128].columns[2u][2u];
                        let _e1562 = (((_e1547 * _e170.member.member_1[0]) + (_e1552 * _e170.member.member_1[1])) + (_e1557 * _e170.member.member_1[2]));
                        let _e1567 = select(_e1522, 0f, (bitcast<f32>((bitcast<u32>(_e1522) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1572 = select(_e1542, 0f, (bitcast<f32>((bitcast<u32>(_e1542) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1577 = select(_e1562, 0f, (bitcast<f32>((bitcast<u32>(_e1562) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1582 = (((_e1567 * _e1567) + (_e1572 * _e1572)) + (_e1577 * _e1577));
                        v50_1 = 0f;
                        if (_e1582 >= bitcast<f32>(67108864u)) {
                            let _e1589 = bitcast<f32>((1597463007u - (bitcast<u32>(_e1582) >> bitcast<u32>(1i))));
                            let _e1590 = (0.5f * _e1582);
                            let _e1594 = (_e1589 * (1.5f - ((_e1590 * _e1589) * _e1589)));
                            v50_1 = (_e1594 * (1.5f - ((_e1590 * _e1594) * _e1594)));
                        }
                        let _e1600 = v50_1;
                        let _e1601 = -(1152921500000000000f);
                        v51_1 = _e1601;
                        if (_e1494 < _e1601) {
                        } else {
                            v51_1 = select(_e1494, 1152921500000000000f, (_e1494 > 1152921500000000000f));
                        }
                        let _e1606 = v51_1;
                        v52_1 = _e1601;
                        if (_e1495 < _e1601) {
                        } else {
                            v52_1 = select(_e1495, 1152921500000000000f, (_e1495 > 1152921500000000000f));
                        }
                        let _e1616 = v52_1;
                        v53_1 = _e1601;
                        if (_e1496 < _e1601) {
                        } else {
                            v53_1 = select(_e1496, 1152921500000000000f, (_e1496 > 1152921500000000000f));
                        }
                        let _e1626 = v53_1;
                        let _e1633 = (_e1567 * _e1600);
                        let _e1639 = (_e1572 * _e1600);
                        let _e1645 = (_e1577 * _e1600);
                        v46_1 = LightbvhType26_(_e1400.member, _e1400.member_1, LightbvhType14_(array<f32, 3>(select(_e1606, 0f, (bitcast<f32>((bitcast<u32>(_e1606) & 2147483647u)) < 0.00000000000000000086736174f)), select(_e1616, 0f, (bitcast<f32>((bitcast<u32>(_e1616) & 2147483647u)) < 0.00000000000000000086736174f)), select(_e1626, 0f, (bitcast<f32>((bitcast<u32>(_e1626) & 2147483647u)) < 0.00000000000000000086736174f))), array<f32, 3>(select(_e1633, 0f, (bitcast<f32>((bitcast<u32>(_e1633) & 2147483647u)) < 0.00000000000000000086736174f)), select(_e1639, 0f, (bitcast<f32>((bitcast<u32>(_e1639) & 2147483647u)) < 0.00000000000000000086736174f)), select(_e1645, 0f, (bitcast<f32>((bitcast<u32>(_e1645) & 2147483647u)) < 0.00000000000000000086736174f)))), _e1400.member_3, _e1400.member_4, _e1400.member_5, _e1400.member_6, _e1400.member_7, _e1400.member_8, _e1400.member_9, _e1400.member_10, _e1400.member_11, _e1400.member_12, _e1400.member_13);
                    }
                    let _e1197 = v46_1;
                    v54_1 = _e1197;
                    if _e1137 {
                    } else {
                        v47_1 = _e365.member_5;
                        if _e1141 {
                            v47_1 = (_e1040 + select(0u, _e144, _e720));
                        }
                        let _e1201 = v47_1;
                        let _e1216 = LightbvhType26_(_e1195.member, _e1195.member_1, _e1195.member_2, _e1195.member_3, _e1195.member_4, _e1201, _e1195.member_6, _e1195.member_7, _e1195.member_8, _e1195.member_9, _e1195.member_10, _e1195.member_11, _e1195.member_12, _e1195.member_13);
                        v54_1 = LightbvhType26_(_e1216.member, _e1216.member_1, _e1216.member_2, _e1216.member_3, _e1216.member_4, _e1216.member_5, _e1216.member_6, _e1216.member_7, (_e365.member_8 + select(0u, 1u, _e1141)), _e1216.member_9, _e1216.member_10, _e1216.member_11, _e1216.member_12, _e1216.member_13);
                    }
                    let _e1669 = v54_1;
                    v55_1 = _e702;
                    v56_1 = _e1669;
                    v57_1 = _e1669.member_12;
                }
                let _e1672 = v55_1;
                let _e1674 = v56_1;
                let _e1676 = v57_1;
                continue;
                continuing {
                    v30_1 = _e1672;
                    v31_1 = _e1674;
                    v32_1 = _e1676;
                    v58_1 = _e1672;
                    break if !(select(true, false, _e367));
                }
            }
            let _e1680 = v58_1;
            if _e1680 {
                break;
            }
            let _e1682 = v59_1;
            let _e1686 = v60_1;
            v63_1 = 0f;
            if (((_e1682.member_6 == _e194) && (_e1686.member_7 == _e177)) && (_e194 != 4294967295u)) {
                let _e1693 = v61_1;
                let _e1698 = v62_1;
                let _e1704 = -(bitcast<i32>((22u + select(98u, _e1693.member_10, (_e1693.member_10 < 98u)))));
                let _e1706 = select(_e1704, -126i, (_e1704 < -126i));
                v63_1 = (f32(bitcast<i32>(_e1698.member_9)) * bitcast<f32>((bitcast<u32>((select(_e1706, 127i, (_e1706 > 127i)) + 127i)) << bitcast<u32>(23i))));
            }
            let _e1716 = v63_1;
            v65_1 = u32();
            v66_1 = true;
            if _e176 {
                v64_1 = u32();
                if _e178 {
                    if _e178 {
                    } else {
                        break;
                    }
                    let _e1719 = lightbvh_instances.list[_e177].count;
                    v64_1 = _e1719;
                }
                let _e1721 = v64_1;
                v65_1 = _e1721;
                v66_1 = select(true, false, _e178);
            }
            let _e1724 = v65_1;
            let _e1726 = v66_1;
            let _e1731 = (select(_e1724, _e165, _e1726) & 2147483647u);
            let _e1736 = bitcast<u32>((f32(65536i) * bitcast<f32>(880803840u)));
            let _e1737 = bitcast<u32>(f32(bitcast<i32>(select(1u, _e1731, (_e1731 > 0u)))));
            let _e1742 = ((_e1736 >> bitcast<u32>(23i)) & 255u);
            let _e1746 = (_e1736 & 8388607u);
            let _e1747 = (_e1746 | 8388608u);
            let _e1748 = (_e1737 & 8388607u);
            let _e1749 = (_e1748 | 8388608u);
            let _e1750 = (_e1747 < _e1749);
            let _e1754 = bitcast<f32>((_e1748 | 1065353216u));
            let _e1755 = bitcast<u32>(_e1754);
            let _e1760 = bitcast<f32>(((_e1755 & 2147483648u) | (2129859015u - (_e1755 & 2147483647u))));
            let _e1763 = (_e1760 * (2f - (_e1754 * _e1760)));
            let _e1766 = (_e1763 * (2f - (_e1754 * _e1763)));
            let _e1770 = ((bitcast<f32>((_e1746 | 1065353216u)) * _e1766) * select(8388608f, 16777216f, _e1750));
            let _e1771 = bitcast<f32>(0u);
            let _e1772 = bitcast<f32>(1333788671u);
            let _e1777 = select(select(u32(_e1770), 0u, (_e1770 < _e1771)), 4294967295u, (_e1770 > _e1772));
            let _e1783 = bitcast<i32>(((_e1747 << bitcast<u32>((select(23i, 24i, _e1750) & 31i))) - (_e1777 * _e1749)));
            let _e1788 = ((f32((_e1783 >> bitcast<u32>(8i))) * _e1766) * 0.000030517578f);
            let _e1789 = bitcast<f32>(3472883712u);
            let _e1790 = bitcast<f32>(1325400063u);
            let _e1797 = select(0i, select(select(i32(_e1788), i32(-2147483648), (_e1788 < _e1789)), 2147483647i, (_e1788 > _e1790)), (_e1788 == _e1788));
            let _e1799 = (_e1777 + bitcast<u32>(_e1797));
            let _e1800 = bitcast<i32>(_e1749);
            let _e1802 = (_e1783 - (_e1797 * _e1800));
            let _e1803 = (_e1802 < 0i);
            v67_1 = _e1799;
            if _e1803 {
                v67_1 = (_e1799 - 1u);
            }
            let _e1806 = v67_1;
            v68_1 = _e1802;
            if _e1803 {
                v68_1 = (_e1802 + _e1800);
            }
            let _e1809 = v68_1;
            let _e1810 = (_e1809 >= _e1800);
            v69_1 = _e1806;
            if _e1810 {
                v69_1 = (_e1806 + 1u);
            }
            let _e1813 = v69_1;
            v70_1 = _e1809;
            if _e1810 {
                v70_1 = (_e1809 - _e1800);
            }
            let _e1816 = v70_1;
            v71_1 = _e1813;
            if ((_e1816 * 2i) > _e1800) {
                v71_1 = (_e1813 + 1u);
            }
            let _e1821 = v71_1;
            let _e1826 = ((bitcast<i32>(_e1742) - bitcast<i32>(((_e1737 >> bitcast<u32>(23i)) & 255u))) + select(127i, 126i, _e1750));
            v74_1 = u32();
            v75_1 = true;
            if (_e1742 == 0u) {
            } else {
                let _e1828 = (_e1826 <= 0i);
                v73_1 = u32();
                if _e1828 {
                } else {
                    v72_1 = 2139095040u;
                    if (_e1826 >= 255i) {
                    } else {
                        v72_1 = ((bitcast<u32>(_e1826) << bitcast<u32>(23i)) + (_e1821 & 8388607u));
                    }
                    let _e1836 = v72_1;
                    v73_1 = _e1836;
                }
                let _e1838 = v73_1;
                v74_1 = _e1838;
                v75_1 = _e1828;
            }
            let _e1840 = v74_1;
            let _e1842 = v75_1;
            let _e1846 = (_e162 & 2147483647u);
            let _e1851 = bitcast<u32>(bitcast<f32>((((_e1736 ^ _e1737) & 2147483648u) | select(_e1840, 0u, _e1842))));
            let _e1852 = bitcast<u32>(f32(bitcast<i32>(select(1u, _e1846, (_e1846 > 0u)))));
            let _e1857 = ((_e1851 >> bitcast<u32>(23i)) & 255u);
            let _e1861 = (_e1851 & 8388607u);
            let _e1862 = (_e1861 | 8388608u);
            let _e1863 = (_e1852 & 8388607u);
            let _e1864 = (_e1863 | 8388608u);
            let _e1865 = (_e1862 < _e1864);
            let _e1869 = bitcast<f32>((_e1863 | 1065353216u));
            let _e1870 = bitcast<u32>(_e1869);
            let _e1875 = bitcast<f32>(((_e1870 & 2147483648u) | (2129859015u - (_e1870 & 2147483647u))));
            let _e1878 = (_e1875 * (2f - (_e1869 * _e1875)));
            let _e1881 = (_e1878 * (2f - (_e1869 * _e1878)));
            let _e1885 = ((bitcast<f32>((_e1861 | 1065353216u)) * _e1881) * select(8388608f, 16777216f, _e1865));
            let _e1890 = select(select(u32(_e1885), 0u, (_e1885 < _e1771)), 4294967295u, (_e1885 > _e1772));
            let _e1896 = bitcast<i32>(((_e1862 << bitcast<u32>((select(23i, 24i, _e1865) & 31i))) - (_e1890 * _e1864)));
            let _e1901 = ((f32((_e1896 >> bitcast<u32>(8i))) * _e1881) * 0.000030517578f);
            let _e1908 = select(0i, select(select(i32(_e1901), i32(-2147483648), (_e1901 < _e1789)), 2147483647i, (_e1901 > _e1790)), (_e1901 == _e1901));
            let _e1910 = (_e1890 + bitcast<u32>(_e1908));
            let _e1911 = bitcast<i32>(_e1864);
            let _e1913 = (_e1896 - (_e1908 * _e1911));
            let _e1914 = (_e1913 < 0i);
            v76_1 = _e1910;
            if _e1914 {
                v76_1 = (_e1910 - 1u);
            }
            let _e1917 = v76_1;
            v77_1 = _e1913;
            if _e1914 {
                v77_1 = (_e1913 + _e1911);
            }
            let _e1920 = v77_1;
            let _e1921 = (_e1920 >= _e1911);
            v78_1 = _e1917;
            if _e1921 {
                v78_1 = (_e1917 + 1u);
            }
            let _e1924 = v78_1;
            v79_1 = _e1920;
            if _e1921 {
                v79_1 = (_e1920 - _e1911);
            }
            let _e1927 = v79_1;
            v80_1 = _e1924;
            if ((_e1927 * 2i) > _e1911) {
                v80_1 = (_e1924 + 1u);
            }
            let _e1932 = v80_1;
            let _e1937 = ((bitcast<i32>(_e1857) - bitcast<i32>(((_e1852 >> bitcast<u32>(23i)) & 255u))) + select(127i, 126i, _e1865));
            v83_1 = u32();
            v84_1 = true;
            if (_e1857 == 0u) {
            } else {
                let _e1939 = (_e1937 <= 0i);
                v82_1 = u32();
                if _e1939 {
                } else {
                    v81_1 = 2139095040u;
                    if (_e1937 >= 255i) {
                    } else {
                        v81_1 = ((bitcast<u32>(_e1937) << bitcast<u32>(23i)) + (_e1932 & 8388607u));
                    }
                    let _e1947 = v81_1;
                    v82_1 = _e1947;
                }
                let _e1949 = v82_1;
                v83_1 = _e1949;
                v84_1 = _e1939;
            }
            let _e1951 = v83_1;
            let _e1953 = v84_1;
            v85_1 = bool();
            if _e176 {
                v86_1 = false;
                if _e178 {
                    if _e178 {
                    } else {
                        break;
                    }
                    let _e1962 = lightbvh_instances.list[_e177].first;
                    let _e1966 = lightbvh_instances.list[_e177].count;
                    v86_1 = ((_e170.member_1[0] - _e1962) < _e1966);
                }
                let _e1969 = v86_1;
                v85_1 = _e1969;
            }
            let _e1958 = v85_1;
            v87_1 = _e1958;
            if _e176 {
            } else {
                v87_1 = (_e170.member_1[0] < _e165);
            }
            let _e1971 = v87_1;
            v88_1 = 0f;
            if _e1971 {
                v88_1 = (_e1716 + bitcast<f32>((((_e1851 ^ _e1852) & 2147483648u) | select(_e1951, 0u, _e1953))));
            }
            let _e1974 = v88_1;
            results_1 = _e1974;
            break;
        }
    }
    let _e2065 = results_1;
    return _e2065;
}

fn lightbvh_sample_cell(center: vec3<f32>, half: vec3<f32>, n_2: vec3<f32>, number_1: vec2<u32>) -> LightbvhLightSample {
    var queries_2: LightbvhType30_;
    var results_2: LightbvhType19_;
    var v0_2: array<f32, 8>;
    var v1_2: u32;
    var v2_2: u32;
    var v3_2: u32;
    var v4_2: u32;
    var v5_2: u32;
    var v6_2: u32;
    var v7_2: u32;
    var v8_2: u32;
    var v9_2: u32;
    var v10_2: u32;
    var v11_2: u32;
    var v12_2: u32;
    var v13_2: bool;
    var v14_2: u32;
    var v15_2: u32;
    var v16_2: u32;
    var v17_2: bool;
    var v18_2: bool;
    var v19_2: LightbvhType24_;
    var v20_2: u32;
    var v21_2: u32;
    var v22_2: u32;
    var v23_2: u32;
    var v24_2: bool;
    var v25_2: u32;
    var v26_2: LightbvhType23_;
    var v27_2: u32;
    var v28_2: u32;
    var v29_2: u32;
    var v30_2: LightbvhType23_;
    var v31_2: u32;
    var v32_2: u32;
    var v33_2: LightbvhType23_;
    var v34_2: u32;
    var v35_2: bool;
    var v36_2: bool;
    var v37_2: LightbvhType23_;
    var v38_2: bool;
    var v39_2: LightbvhType24_;
    var v40_2: bool;
    var v41_2: LightbvhType24_;
    var v42_2: u32;
    var v43_2: u32;
    var v44_2: bool;
    var v45_2: LightbvhType32_;
    var v46_2: bool;
    var v47_2: LightbvhType23_;
    var v48_2: LightbvhType23_;
    var v49_2: LightbvhType23_;
    var v50_2: LightbvhType23_;
    var v51_2: LightbvhType23_;
    var v52_2: bool;
    var v53_2: u32;
    var v54_2: u32;
    var v55_2: u32;
    var v56_2: u32;
    var v57_2: i32;
    var v58_2: u32;
    var v59_2: bool;
    var v60_2: LightbvhType32_;
    var v61_2: u32;
    var v62_2: u32;
    var v63_2: LightbvhType32_;
    var v64_2: f32;
    var v65_2: f32;
    var v66_2: f32;
    var v67_2: f32;
    var v68_2: LightbvhType32_;
    var v69_2: bool;
    var v70_2: LightbvhType32_;
    var v71_2: bool;
    var v72_2: bool;
    var v73_2: LightbvhType32_;
    var v74_2: LightbvhType32_;
    var v75_2: LightbvhType32_;
    var v76_2: LightbvhType32_;
    var v77_2: u32;
    var v78_2: u32;
    var v79_2: LightbvhType32_;
    var v80_2: LightbvhType32_;
    var v81_2: f32;
    var v82_2: u32;
    var v83_2: u32;
    var v84_2: bool;
    var v85_2: u32;
    var v86_2: i32;
    var v87_2: u32;
    var v88_2: i32;
    var v89_1: u32;
    var v90_1: u32;
    var v91_1: u32;
    var v92_1: u32;
    var v93_1: bool;
    var v94_1: u32;
    var v95_1: i32;
    var v96_1: u32;
    var v97_1: i32;
    var v98_1: u32;
    var v99_1: u32;
    var v100_1: u32;
    var v101_1: u32;
    var v102_1: bool;
    var v103_1: LightbvhType19_;

    queries_2 = LightbvhType30_(LightbvhType29_(array<f32, 3>(center.x, center.y, center.z), array<f32, 3>(half.x, half.y, half.z), array<f32, 3>(n_2.x, n_2.y, n_2.z)), array<u32, 2>(number_1.x, number_1.y));
    switch bitcast<i32>(0u) {
        default: {
            let _e148 = arrayLength((&lightbvh_nodes.list));
            let _e151 = arrayLength((&lightbvh_instances.list));
            let _e154 = arrayLength((&lightbvh_trails.list));
            let _e157 = lightbvh_tree.top;
            let _e160 = lightbvh_tree.root;
            let _e163 = lightbvh_tree.above;
            let _e166 = lightbvh_tree.places;
            let _e169 = lightbvh_tree.parts;
            let _e172 = lightbvh_tree.trail_words;
            let _e175 = lightbvh_tree.live;
            let _e178 = lightbvh_tree.lights;
            let _e181 = lightbvh_tree.depth;
            let _e183 = queries_2;
            v40_2 = false;
            v41_2 = LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u));
            v42_2 = 4294967295u;
            v43_2 = 4294967295u;
            if ((_e183.member_1[0] >> bitcast<u32>(10u)) < 65536u) {
                let _e198 = ((_e183.member_1[0] << bitcast<u32>(6u)) | ((_e183.member_1[1] >> bitcast<u32>(1i)) >> bitcast<u32>(25u)));
                let _e200 = (_e183.member_1[1] << bitcast<u32>(6u));
                let _e201 = (_e175 > 0u);
                v1_2 = u32();
                v2_2 = u32();
                if _e201 {
                    let _e254 = (_e200 >> bitcast<u32>(16i));
                    let _e255 = (_e200 & 65535u);
                    let _e257 = (_e175 >> bitcast<u32>(16i));
                    let _e258 = (_e175 & 65535u);
                    let _e263 = ((_e254 * _e258) + ((_e255 * _e258) >> bitcast<u32>(16i)));
                    let _e274 = (_e200 * _e175);
                    let _e276 = (_e198 >> bitcast<u32>(16i));
                    let _e277 = (_e198 & 65535u);
                    let _e282 = ((_e276 * _e258) + ((_e277 * _e258) >> bitcast<u32>(16i)));
                    let _e293 = (_e198 * _e175);
                    let _e294 = (_e293 + (((_e254 * _e257) + (_e263 >> bitcast<u32>(16i))) + (((_e255 * _e257) + (_e263 & 65535u)) >> bitcast<u32>(16i))));
                    let _e297 = ((((_e276 * _e257) + (_e282 >> bitcast<u32>(16i))) + (((_e277 * _e257) + (_e282 & 65535u)) >> bitcast<u32>(16i))) + select(0u, 1u, (_e294 < _e293)));
                    let _e298 = (_e297 < _e151);
                    v7_2 = 4294967295u;
                    v8_2 = 4294967295u;
                    if _e298 {
                        if _e298 {
                        } else {
                            break;
                        }
                        let _e301 = lightbvh_instances.list[_e297].listed;
                        let _e302 = (_e301 < _e151);
                        v5_2 = 4294967295u;
                        v6_2 = 4294967295u;
                        if _e302 {
                            if _e302 {
                            } else {
                                break;
                            }
                            let _e305 = lightbvh_instances.list[_e301].count;
                            let _e306 = (_e305 > 0u);
                            v4_2 = 4294967295u;
                            if _e306 {
                                let _e309 = lightbvh_instances.list[_e301].first;
                                let _e311 = (_e274 >> bitcast<u32>(16i));
                                let _e312 = (_e274 & 65535u);
                                let _e314 = (_e305 >> bitcast<u32>(16i));
                                let _e315 = (_e305 & 65535u);
                                let _e320 = ((_e311 * _e315) + ((_e312 * _e315) >> bitcast<u32>(16i)));
                                let _e332 = (_e294 >> bitcast<u32>(16i));
                                let _e333 = (_e294 & 65535u);
                                let _e338 = ((_e332 * _e315) + ((_e333 * _e315) >> bitcast<u32>(16i)));
                                let _e349 = (_e294 * _e305);
                                v4_2 = (_e309 + ((((_e332 * _e314) + (_e338 >> bitcast<u32>(16i))) + (((_e333 * _e314) + (_e338 & 65535u)) >> bitcast<u32>(16i))) + select(0u, 1u, ((_e349 + (((_e311 * _e314) + (_e320 >> bitcast<u32>(16i))) + (((_e312 * _e314) + (_e320 & 65535u)) >> bitcast<u32>(16i)))) < _e349))));
                            }
                            let _e356 = v4_2;
                            v5_2 = _e356;
                            v6_2 = select(4294967295u, _e301, _e306);
                        }
                        let _e359 = v5_2;
                        let _e361 = v6_2;
                        v7_2 = _e359;
                        v8_2 = _e361;
                    }
                    let _e363 = v7_2;
                    let _e365 = v8_2;
                    v1_2 = _e363;
                    v2_2 = _e365;
                }
                let _e203 = v1_2;
                let _e205 = v2_2;
                v9_2 = _e203;
                v10_2 = _e205;
                if _e201 {
                } else {
                    v3_2 = 4294967295u;
                    if (_e178 > 0u) {
                        let _e208 = (_e200 >> bitcast<u32>(16i));
                        let _e209 = (_e200 & 65535u);
                        let _e211 = (_e178 >> bitcast<u32>(16i));
                        let _e212 = (_e178 & 65535u);
                        let _e217 = ((_e208 * _e212) + ((_e209 * _e212) >> bitcast<u32>(16i)));
                        let _e229 = (_e198 >> bitcast<u32>(16i));
                        let _e230 = (_e198 & 65535u);
                        let _e235 = ((_e229 * _e212) + ((_e230 * _e212) >> bitcast<u32>(16i)));
                        let _e246 = (_e198 * _e178);
                        v3_2 = ((((_e229 * _e211) + (_e235 >> bitcast<u32>(16i))) + (((_e230 * _e211) + (_e235 & 65535u)) >> bitcast<u32>(16i))) + select(0u, 1u, ((_e246 + (((_e208 * _e211) + (_e217 >> bitcast<u32>(16i))) + (((_e209 * _e211) + (_e217 & 65535u)) >> bitcast<u32>(16i)))) < _e246)));
                    }
                    let _e252 = v3_2;
                    v9_2 = _e252;
                    v10_2 = 4294967295u;
                }
                let _e367 = v9_2;
                let _e369 = v10_2;
                let _e370 = (_e369 < _e151);
                v12_2 = u32();
                v13_2 = true;
                if _e370 {
                    v11_2 = u32();
                    if _e201 {
                        if _e370 {
                        } else {
                            break;
                        }
                        let _e373 = lightbvh_instances.list[_e369].first;
                        let _e377 = lightbvh_instances.list[_e369].first_light;
                        v11_2 = ((_e367 - _e373) + _e377);
                    }
                    let _e380 = v11_2;
                    v12_2 = _e380;
                    v13_2 = select(true, false, _e201);
                }
                let _e383 = v12_2;
                let _e385 = v13_2;
                let _e387 = (select(_e383, _e367, _e385) * _e172);
                let _e388 = (_e387 < _e154);
                v14_2 = 0u;
                if _e388 {
                    if _e388 {
                    } else {
                        break;
                    }
                    let _e390 = lightbvh_trails.list[_e387];
                    v14_2 = _e390;
                }
                let _e392 = v14_2;
                v16_2 = u32();
                v17_2 = true;
                if (_e172 == 2u) {
                    let _e394 = (_e387 + 1u);
                    let _e395 = (_e394 < _e154);
                    v15_2 = u32();
                    if _e395 {
                        if _e395 {
                        } else {
                            break;
                        }
                        let _e397 = lightbvh_trails.list[_e394];
                        v15_2 = _e397;
                    }
                    let _e399 = v15_2;
                    v16_2 = _e399;
                    v17_2 = select(true, false, _e395);
                }
                let _e402 = v16_2;
                let _e404 = v17_2;
                let _e405 = select(_e402, 0u, _e404);
                v18_2 = bool();
                v19_2 = LightbvhType24_();
                if _e370 {
                    let _e412 = (_e166 + _e369);
                    let _e413 = (_e412 < _e154);
                    v20_2 = 4294967295u;
                    if _e413 {
                        if _e413 {
                        } else {
                            break;
                        }
                        let _e415 = lightbvh_trails.list[_e412];
                        v20_2 = _e415;
                    }
                    let _e417 = v20_2;
                    v23_2 = u32();
                    v24_2 = true;
                    if (_e417 != 4294967295u) {
                        let _e419 = (_e417 >= 2147483648u);
                        v22_2 = u32();
                        if _e419 {
                            let _e423 = (_e169 + ((_e417 - 2147483648u) + (_e392 & 7u)));
                            let _e424 = (_e423 < _e154);
                            v21_2 = 4294967295u;
                            if _e424 {
                                if _e424 {
                                } else {
                                    break;
                                }
                                let _e426 = lightbvh_trails.list[_e423];
                                v21_2 = _e426;
                            }
                            let _e428 = v21_2;
                            v22_2 = _e428;
                        }
                        let _e430 = v22_2;
                        v23_2 = _e430;
                        v24_2 = select(true, false, _e419);
                    }
                    let _e433 = v23_2;
                    let _e435 = v24_2;
                    v25_2 = 0u;
                    v26_2 = LightbvhType23_(0u, 0u);
                    v27_2 = select(_e433, _e417, _e435);
                    loop {
                        let _e438 = v25_2;
                        let _e440 = v26_2;
                        let _e442 = v27_2;
                        v37_2 = _e440;
                        v32_2 = u32();
                        v33_2 = LightbvhType23_();
                        v34_2 = u32();
                        v35_2 = false;
                        if (_e442 < 2147483648u) {
                            let _e444 = (_e438 < 20u);
                            v29_2 = u32();
                            v30_2 = LightbvhType23_();
                            v31_2 = u32();
                            if _e444 {
                                let _e463 = (_e163 + (_e442 >> bitcast<u32>(3u)));
                                let _e464 = (_e463 < _e154);
                                v28_2 = 4294967295u;
                                if _e464 {
                                    if _e464 {
                                    } else {
                                        v36_2 = true;
                                        break;
                                    }
                                    let _e466 = lightbvh_trails.list[_e463];
                                    v28_2 = _e466;
                                }
                                let _e468 = v28_2;
                                v29_2 = (_e438 + 1u);
                                v30_2 = LightbvhType23_((((_e440.member << bitcast<u32>(3u)) | ((_e442 & 7u) & 7u)) & 1073741823u), (((_e440.member_1 << bitcast<u32>(3u)) | ((_e440.member >> bitcast<u32>(27u)) & 7u)) & 1073741823u));
                                v31_2 = _e468;
                            }
                            let _e471 = v29_2;
                            let _e473 = v30_2;
                            let _e475 = v31_2;
                            v32_2 = _e471;
                            v33_2 = _e473;
                            v34_2 = _e475;
                            v35_2 = _e444;
                        }
                        let _e477 = v32_2;
                        let _e479 = v33_2;
                        let _e481 = v34_2;
                        let _e483 = v35_2;
                        continue;
                        continuing {
                            v25_2 = _e477;
                            v26_2 = _e479;
                            v27_2 = _e481;
                            v36_2 = false;
                            break if !(_e483);
                        }
                    }
                    let _e486 = v36_2;
                    if _e486 {
                        break;
                    }
                    let _e489 = v37_2;
                    v18_2 = _e486;
                    v19_2 = LightbvhType24_(_e489, LightbvhType23_(_e392, _e405));
                }
                let _e407 = v18_2;
                let _e409 = v19_2;
                v38_2 = _e407;
                v39_2 = _e409;
                if _e370 {
                } else {
                    v38_2 = false;
                    v39_2 = LightbvhType24_(LightbvhType23_(_e392, _e405), LightbvhType23_(0u, 0u));
                }
                let _e492 = v38_2;
                let _e494 = v39_2;
                v40_2 = _e492;
                v41_2 = _e494;
                v42_2 = _e369;
                v43_2 = _e367;
            }
            let _e496 = v40_2;
            let _e498 = v41_2;
            let _e500 = v42_2;
            let _e502 = v43_2;
            let _e505 = (_e181 == 0u);
            let _e507 = LightbvhType31_(_e498, LightbvhType23_(_e183.member_1[0], _e183.member_1[1]), LightbvhType25_(0f, 1f), 0u, (_e160 + _e157), 4294967295u, 4294967295u, 0u, 4194304u, 0u, _e183.member, _e181, _e505, (_e502 != 4294967295u));
            let _e510 = (bitcast<u32>(21i) - firstLeadingBit(4128767u));
            let _e512 = select(22u, _e510, (_e510 < 22u));
            let _e520 = (_e512 & 31u);
            let _e541 = LightbvhType31_(_e507.member, LightbvhType23_((((_e183.member_1[0] - 67108864u) << bitcast<u32>(_e520)) | ((_e183.member_1[1] >> bitcast<u32>(1i)) >> bitcast<u32>(((31u - _e512) & 31u)))), (_e183.member_1[1] << bitcast<u32>(_e520))), _e507.member_2, _e507.member_3, _e507.member_4, _e507.member_5, _e507.member_6, _e507.member_7, _e507.member_8, _e507.member_9, _e507.member_10, _e507.member_11, _e507.member_12, _e507.member_13);
            let _e558 = LightbvhType31_(_e541.member, _e541.member_1, _e541.member_2, _e541.member_3, _e541.member_4, _e541.member_5, _e541.member_6, _e541.member_7, (4128768u << bitcast<u32>(_e520)), _e541.member_9, _e541.member_10, _e541.member_11, _e541.member_12, _e541.member_13);
            v44_2 = _e496;
            v45_2 = LightbvhType32_(_e502, _e500, LightbvhType31_(_e558.member, _e558.member_1, _e558.member_2, _e558.member_3, _e558.member_4, _e558.member_5, _e558.member_6, _e558.member_7, _e558.member_8, _e512, _e558.member_10, _e558.member_11, _e558.member_12, _e558.member_13));
            v46_2 = _e505;
            loop {
                let _e576 = v44_2;
                let _e578 = v45_2;
                let _e580 = v46_2;
                v73_2 = _e578;
                v74_2 = _e578;
                v75_2 = _e578;
                v76_2 = _e578;
                v79_2 = _e578;
                v80_2 = _e578;
                v69_2 = _e576;
                v70_2 = LightbvhType32_();
                v71_2 = bool();
                if _e580 {
                } else {
                    let _e583 = (_e578.member_2.member_4 < _e148);
                    let _e584 = select(0u, _e578.member_2.member_4, _e583);
                    if (_e584 < _e148) {
                    } else {
                        v72_2 = true;
                        break;
                    }
                    let _e625 = lightbvh_nodes.list[_e584][0u][3u];
                    let _e628 = (bitcast<i32>((_e625 & 255u)) - 127i);
                    let _e638 = bitcast<f32>((bitcast<u32>(_e578.member_2.member_10.member_1[0]) & 2147483647u));
                    let _e641 = bitcast<f32>((bitcast<u32>(_e578.member_2.member_10.member_1[1]) & 2147483647u));
                    let _e644 = bitcast<f32>((bitcast<u32>(_e578.member_2.member_10.member_1[2]) & 2147483647u));
                    let _e646 = select(_e641, _e638, (_e638 > _e641));
                    let _e654 = (bitcast<i32>(((bitcast<u32>(select(_e644, _e646, (_e646 > _e644))) >> bitcast<u32>(23i)) & 255u)) - 127i);
                    let _e656 = select(_e628, _e654, (_e654 > _e628));
                    let _e662 = (1f - (((_e578.member_2.member_10.member_2[0] * _e578.member_2.member_10.member_2[0]) + (_e578.member_2.member_10.member_2[1] * _e578.member_2.member_10.member_2[1])) + (_e578.member_2.member_10.member_2[2] * _e578.member_2.member_10.member_2[2])));
                    let _e664 = select(0.0000038146973f, _e662, (_e662 > 0.0000038146973f));
                    let _e669 = bitcast<f32>((1595932665u - (bitcast<u32>(_e664) >> bitcast<u32>(1i))));
                    let _e676 = (0.5f * (_e664 * (_e669 * (0.70395225f * (2.3892446f - (_e664 * (_e669 * _e669)))))));
                    let _e678 = (0.0001f + _e676);
                    let _e682 = lightbvh_nodes.list[_e584][0u][0u];
                    let _e687 = lightbvh_nodes.list[_e584][0u][1u];
                    let _e692 = lightbvh_nodes.list[_e584][0u][2u];
                    let _e694 = (bitcast<f32>(_e682) - _e578.member_2.member_10.member[0]);
                    let _e695 = (bitcast<f32>(_e687) - _e578.member_2.member_10.member[1]);
                    let _e696 = (bitcast<f32>(_e692) - _e578.member_2.member_10.member[2]);
                    let _e699 = bitcast<f32>((bitcast<u32>(_e694) & 2147483647u));
                    let _e702 = bitcast<f32>((bitcast<u32>(_e695) & 2147483647u));
                    let _e705 = bitcast<f32>((bitcast<u32>(_e696) & 2147483647u));
                    let _e707 = select(_e702, _e699, (_e699 > _e702));
                    let _e715 = (bitcast<i32>(((bitcast<u32>(select(_e705, _e707, (_e707 > _e705))) >> bitcast<u32>(23i)) & 255u)) - 127i);
                    let _e717 = select(_e656, _e715, (_e715 > _e656));
                    let _e718 = (_e628 - _e717);
                    let _e720 = select(_e718, -40i, (_e718 < -40i));
                    let _e721 = -(_e717);
                    let _e723 = select(_e721, -126i, (_e721 < -126i));
                    let _e730 = bitcast<f32>((bitcast<u32>((select(_e723, 127i, (_e723 > 127i)) + 127i)) << bitcast<u32>(23i)));
                    let _e735 = select(_e720, -126i, (_e720 < -126i));
                    let _e742 = bitcast<f32>((bitcast<u32>((select(_e735, 127i, (_e735 > 127i)) + 127i)) << bitcast<u32>(23i)));
                    let _e743 = (_e578.member_2.member_10.member_1[0] * _e730);
                    let _e744 = (_e578.member_2.member_10.member_1[1] * _e730);
                    let _e745 = (_e578.member_2.member_10.member_1[2] * _e730);
                    let _e748 = bitcast<f32>((bitcast<u32>(_e578.member_2.member_10.member_2[0]) & 2147483647u));
                    let _e751 = bitcast<f32>((bitcast<u32>(_e578.member_2.member_10.member_2[1]) & 2147483647u));
                    let _e754 = bitcast<f32>((bitcast<u32>(_e578.member_2.member_10.member_2[2]) & 2147483647u));
                    let _e759 = (((_e743 * _e748) + (_e744 * _e751)) + (_e745 * _e754));
                    let _e766 = ((0.22222222f * (((_e743 * _e743) + (_e744 * _e744)) + (_e745 * _e745))) + 0.0000000000000008881784f);
                    let _e768 = (_e742 * 0.0000000004656613f);
                    let _e771 = (2f * 8f);
                    let _e772 = (_e748 * _e771);
                    let _e773 = (_e751 * _e771);
                    let _e774 = (_e754 * _e771);
                    v0_2 = array<f32, 8>(0f, 0f, 0f, 0f, 0f, 0f, 0f, 0f);
                    v47_2 = LightbvhType23_(0u, 8u);
                    loop {
                        let _e781 = v47_2;
                        let _e784 = (_e781.member < _e781.member_1);
                        v48_2 = LightbvhType23_();
                        v49_2 = LightbvhType23_();
                        if _e784 {
                            v48_2 = LightbvhType23_((_e781.member + 1u), _e781.member_1);
                            v49_2 = LightbvhType23_(1u, _e781.member);
                        }
                        let _e786 = v48_2;
                        let _e788 = v49_2;
                        v50_2 = _e786;
                        v51_2 = _e788;
                        if _e784 {
                        } else {
                            v50_2 = _e781;
                            v51_2 = LightbvhType23_(0u, LightbvhType23_().member_1);
                        }
                        let _e798 = v50_2;
                        let _e800 = v51_2;
                        let _e804 = (bitcast<i32>(_e800.member) != 0i);
                        if _e804 {
                            let _e805 = (_e800.member_1 < 8u);
                            if _e805 {
                            } else {
                                v52_2 = true;
                                break;
                            }
                            let _e809 = lightbvh_nodes.list[_e584][1u][_e800.member_1];
                            if _e805 {
                            } else {
                                v52_2 = true;
                                break;
                            }
                            let _e813 = lightbvh_nodes.list[_e584][2u][_e800.member_1];
                            if _e805 {
                            } else {
                                v52_2 = true;
                                break;
                            }
                            let _e817 = lightbvh_nodes.list[_e584][3u][_e800.member_1];
                            if _e805 {
                            } else {
                                v52_2 = true;
                                break;
                            }
                            let _e821 = lightbvh_nodes.list[_e584][4u][_e800.member_1];
                            let _e837 = ((_e694 * _e730) + (f32(bitcast<i32>(_e809)) * _e768));
                            let _e838 = ((_e695 * _e730) + (f32(bitcast<i32>((_e809 << bitcast<u32>(15u)))) * _e768));
                            let _e839 = ((_e696 * _e730) + (f32(bitcast<i32>(_e813)) * _e768));
                            let _e844 = bitcast<f32>((((_e821 << bitcast<u32>(20u)) & 267386880u) + (bitcast<u32>(_e742) + 4043309056u)));
                            let _e851 = f32(bitcast<i32>(_e817));
                            let _e855 = f32(bitcast<i32>((_e817 << bitcast<u32>(8u))));
                            let _e859 = f32(bitcast<i32>((_e817 << bitcast<u32>(16u))));
                            let _e863 = (f32(bitcast<i32>((_e817 & 255u))) * 0.003921569f);
                            let _e880 = (_e844 * _e844);
                            let _e881 = (1f + (f32(bitcast<i32>((_e813 << bitcast<u32>(15u)))) * 0.0000000004656613f));
                            let _e882 = (_e880 + _e766);
                            let _e885 = ((_e880 * (_e881 * _e881)) + _e766);
                            let _e890 = bitcast<f32>((1595932665u - (bitcast<u32>(_e882) >> bitcast<u32>(1i))));
                            let _e895 = (_e890 * (0.70395225f * (2.3892446f - (_e882 * (_e890 * _e890)))));
                            let _e896 = (_e882 * _e895);
                            let _e901 = bitcast<f32>((1595932665u - (bitcast<u32>(_e885) >> bitcast<u32>(1i))));
                            let _e909 = (((_e885 * (_e901 * (0.70395225f * (2.3892446f - (_e885 * (_e901 * _e901)))))) * _e895) - 1f);
                            let _e922 = (bitcast<f32>((bitcast<u32>(_e837) & 2147483647u)) - _e743);
                            let _e923 = (bitcast<f32>((bitcast<u32>(_e838) & 2147483647u)) - _e744);
                            let _e924 = (bitcast<f32>((bitcast<u32>(_e839) & 2147483647u)) - _e745);
                            let _e926 = select(0f, _e922, (_e922 > 0f));
                            let _e928 = select(0f, _e923, (_e923 > 0f));
                            let _e930 = select(0f, _e924, (_e924 > 0f));
                            let _e931 = (_e896 * _e896);
                            let _e937 = ((((_e837 * _e837) + (_e838 * _e838)) + (_e839 * _e839)) + 0.0000000000000008881784f);
                            let _e947 = (_e937 + (1.25f * _e931));
                            let _e952 = bitcast<f32>((1595932665u - (bitcast<u32>(_e947) >> bitcast<u32>(1i))));
                            let _e957 = (_e952 * (0.70395225f * (2.3892446f - (_e947 * (_e952 * _e952)))));
                            let _e958 = (_e896 * _e957);
                            let _e963 = ((((_e578.member_2.member_10.member_2[0] * 0.0000000004656613f) * _e851) + ((_e578.member_2.member_10.member_2[1] * 0.0000000004656613f) * _e855)) + ((_e578.member_2.member_10.member_2[2] * 0.0000000004656613f) * _e859));
                            let _e968 = ((0.03162278f + _e676) + (_e958 * (1f + (_e909 * (_e963 * _e963)))));
                            let _e974 = (((((_e578.member_2.member_10.member_2[0] + _e578.member_2.member_10.member_2[0]) * _e837) + ((_e578.member_2.member_10.member_2[1] + _e578.member_2.member_10.member_2[1]) * _e838)) + ((_e578.member_2.member_10.member_2[2] + _e578.member_2.member_10.member_2[2]) * _e839)) * _e957);
                            let _e976 = (_e974 + (((((((_e772 + _e773) + _e774) + ((((_e772 * 0.0000000004656613f) * f32(bitcast<i32>(_e821))) + ((_e773 * 0.0000000004656613f) * f32(bitcast<i32>((_e821 << bitcast<u32>(8u)))))) + ((_e774 * 0.0000000004656613f) * f32(bitcast<i32>((_e821 << bitcast<u32>(16u))))))) * _e844) + (_e759 + _e759)) * _e895) * _e958));
                            let _e978 = select(_e678, _e976, (_e976 > _e678));
                            let _e984 = (bitcast<f32>((bitcast<u32>(_e974) & 2147483647u)) + _e968);
                            let _e990 = (1f + _e909);
                            let _e996 = ((((_e851 * _e837) + (_e855 * _e838)) + (_e859 * _e839)) * (-2f * 0.0000000004656613f));
                            let _e999 = (_e896 * select(_e863, _e990, (_e990 > _e863)));
                            let _e1001 = (_e937 - (2.5f * _e931));
                            let _e1003 = (0.25f * (_e996 * _e996));
                            let _e1009 = ((select(_e1003, _e1001, (_e1001 > _e1003)) + 0.0000000000000008881784f) + (1.25f * (_e999 * _e999)));
                            let _e1014 = bitcast<f32>((1595932665u - (bitcast<u32>(_e1009) >> bitcast<u32>(1i))));
                            let _e1019 = (_e1014 * (0.70395225f * (2.3892446f - (_e1009 * (_e1014 * _e1014)))));
                            let _e1021 = ((_e896 * _e1019) * _e990);
                            let _e1025 = ((0.03162278f + _e1021) + (_e863 * (0.5f - _e1021)));
                            let _e1026 = (_e996 * _e1019);
                            let _e1030 = (bitcast<f32>((bitcast<u32>(_e1026) & 2147483647u)) + _e1025);
                            let _e1039 = ((_e984 * _e1030) * (((((_e926 * _e926) + (_e928 * _e928)) + (_e930 * _e930)) + 0.0000000000000008881784f) + (0.5f * _e931)));
                            let _e1042 = bitcast<f32>((2129859015u - bitcast<u32>(_e1039)));
                            if _e805 {
                            } else {
                                v52_2 = true;
                                break;
                            }
                            v0_2[_e800.member_1] = ((bitcast<f32>(((_e813 & 2047u) << bitcast<u32>(19u))) * (((select(0f, _e974, (_e974 > 0f)) * _e984) + (_e968 * select(_e968, _e978, (_e978 < _e968)))) * ((select(0f, _e1026, (_e1026 > 0f)) * _e1030) + (_e1025 * _e1025)))) * (_e1042 * (2f - (_e1039 * _e1042))));
                        }
                        continue;
                        continuing {
                            v47_2 = _e798;
                            v52_2 = _e576;
                            break if !(_e804);
                        }
                    }
                    let _e1050 = v52_2;
                    v72_2 = _e1050;
                    if _e1050 {
                        break;
                    }
                    let _e1051 = v0_2;
                    let _e1073 = (_e578.member_2.member_7 < 20u);
                    v53_2 = u32();
                    if _e1073 {
                        let _e1096 = (_e578.member_2.member_7 < 10u);
                        v55_2 = _e578.member_2.member_7;
                        if _e1096 {
                        } else {
                            v55_2 = (_e578.member_2.member_7 - 10u);
                        }
                        let _e1099 = v55_2;
                        v53_2 = ((select(_e578.member_2.member.member.member_1, _e578.member_2.member.member.member, _e1096) >> bitcast<u32>((((_e1099 * 3u) & 31u) & 31u))) & 7u);
                    }
                    let _e1075 = v53_2;
                    v56_2 = _e1075;
                    if _e1073 {
                    } else {
                        let _e1080 = (_e578.member_2.member_7 - 20u);
                        let _e1081 = (_e1080 < 10u);
                        v54_2 = _e1080;
                        if _e1081 {
                        } else {
                            v54_2 = (_e578.member_2.member_7 - 30u);
                        }
                        let _e1084 = v54_2;
                        v56_2 = ((select(_e578.member_2.member.member_1.member_1, _e578.member_2.member.member_1.member, _e1081) >> bitcast<u32>((((_e1084 * 3u) & 31u) & 31u))) & 7u);
                    }
                    let _e1108 = v56_2;
                    let _e1113 = (0u - select(0u, 1u, (_e1051[1] > 0f)));
                    let _e1114 = (1u & _e1113);
                    let _e1118 = (0u - select(0u, 1u, (_e1051[2] > 0f)));
                    let _e1121 = (_e1114 ^ ((2u ^ _e1114) & _e1118));
                    let _e1125 = (0u - select(0u, 1u, (_e1051[3] > 0f)));
                    let _e1128 = (_e1121 ^ ((3u ^ _e1121) & _e1125));
                    let _e1132 = (0u - select(0u, 1u, (_e1051[4] > 0f)));
                    let _e1135 = (_e1128 ^ ((4u ^ _e1128) & _e1132));
                    let _e1139 = (0u - select(0u, 1u, (_e1051[5] > 0f)));
                    let _e1142 = (_e1135 ^ ((5u ^ _e1135) & _e1139));
                    let _e1146 = (0u - select(0u, 1u, (_e1051[6] > 0f)));
                    let _e1149 = (_e1142 ^ ((6u ^ _e1142) & _e1146));
                    let _e1153 = (0u - select(0u, 1u, (_e1051[7] > 0f)));
                    let _e1156 = (_e1149 ^ ((7u ^ _e1149) & _e1153));
                    let _e1159 = ((((0f + _e1051[0]) + _e1051[4]) + ((0f + _e1051[2]) + _e1051[6])) + (((0f + _e1051[1]) + _e1051[5]) + ((0f + _e1051[3]) + _e1051[7])));
                    let _e1160 = (_e1159 > 0f);
                    let _e1164 = select(1f, _e1159, _e1160);
                    let _e1165 = bitcast<u32>(_e1164);
                    let _e1170 = bitcast<f32>(((_e1165 & 2147483648u) | (2129859015u - (_e1165 & 2147483647u))));
                    let _e1173 = (_e1170 * (2f - (_e1164 * _e1170)));
                    let _e1177 = ((f32(bitcast<i32>(_e578.member_2.member_8)) * 0.9999695f) * (_e1173 * (2f - (_e1164 * _e1173))));
                    v57_2 = 2147483647i;
                    if _e578.member_2.member_13 {
                    } else {
                        v57_2 = bitcast<i32>((_e578.member_2.member_1.member >> bitcast<u32>(10u)));
                    }
                    let _e1180 = v57_2;
                    let _e1186 = bitcast<i32>((bitcast<u32>(((_e1051[0] * _e1177) + 8388608f)) & 8388607u));
                    let _e1193 = (select(1i, _e1186, (_e1186 > 1i)) & bitcast<i32>((0u - select(0u, 1u, (_e1051[0] > 0f)))));
                    let _e1194 = bitcast<u32>(_e1193);
                    let _e1195 = (_e1194 & 4294967295u);
                    let _e1197 = bitcast<i32>(select(_e1156, _e1108, _e578.member_2.member_13));
                    let _e1201 = (0u - select(0u, 1u, ((_e1193 <= _e1180) && (0i < _e1197))));
                    let _e1202 = (_e1194 & _e1201);
                    let _e1208 = bitcast<i32>((bitcast<u32>(((_e1051[1] * _e1177) + 8388608f)) & 8388607u));
                    let _e1213 = (_e1193 + (select(1i, _e1208, (_e1208 > 1i)) & bitcast<i32>(_e1113)));
                    let _e1214 = bitcast<u32>(_e1213);
                    let _e1217 = (_e1195 ^ ((_e1214 ^ _e1195) & _e1201));
                    let _e1222 = (0u - select(0u, 1u, ((_e1213 <= _e1180) && (1i < _e1197))));
                    let _e1225 = (_e1202 ^ ((_e1214 ^ _e1202) & _e1222));
                    let _e1232 = bitcast<i32>((bitcast<u32>(((_e1051[2] * _e1177) + 8388608f)) & 8388607u));
                    let _e1237 = (_e1213 + (select(1i, _e1232, (_e1232 > 1i)) & bitcast<i32>(_e1118)));
                    let _e1238 = bitcast<u32>(_e1237);
                    let _e1241 = (_e1217 ^ ((_e1238 ^ _e1217) & _e1222));
                    let _e1246 = (0u - select(0u, 1u, ((_e1237 <= _e1180) && (2i < _e1197))));
                    let _e1249 = (_e1225 ^ ((_e1238 ^ _e1225) & _e1246));
                    let _e1256 = bitcast<i32>((bitcast<u32>(((_e1051[3] * _e1177) + 8388608f)) & 8388607u));
                    let _e1261 = (_e1237 + (select(1i, _e1256, (_e1256 > 1i)) & bitcast<i32>(_e1125)));
                    let _e1262 = bitcast<u32>(_e1261);
                    let _e1265 = (_e1241 ^ ((_e1262 ^ _e1241) & _e1246));
                    let _e1270 = (0u - select(0u, 1u, ((_e1261 <= _e1180) && (3i < _e1197))));
                    let _e1273 = (_e1249 ^ ((_e1262 ^ _e1249) & _e1270));
                    let _e1280 = bitcast<i32>((bitcast<u32>(((_e1051[4] * _e1177) + 8388608f)) & 8388607u));
                    let _e1285 = (_e1261 + (select(1i, _e1280, (_e1280 > 1i)) & bitcast<i32>(_e1132)));
                    let _e1286 = bitcast<u32>(_e1285);
                    let _e1289 = (_e1265 ^ ((_e1286 ^ _e1265) & _e1270));
                    let _e1294 = (0u - select(0u, 1u, ((_e1285 <= _e1180) && (4i < _e1197))));
                    let _e1297 = (_e1273 ^ ((_e1286 ^ _e1273) & _e1294));
                    let _e1304 = bitcast<i32>((bitcast<u32>(((_e1051[5] * _e1177) + 8388608f)) & 8388607u));
                    let _e1309 = (_e1285 + (select(1i, _e1304, (_e1304 > 1i)) & bitcast<i32>(_e1139)));
                    let _e1310 = bitcast<u32>(_e1309);
                    let _e1313 = (_e1289 ^ ((_e1310 ^ _e1289) & _e1294));
                    let _e1318 = (0u - select(0u, 1u, ((_e1309 <= _e1180) && (5i < _e1197))));
                    let _e1321 = (_e1297 ^ ((_e1310 ^ _e1297) & _e1318));
                    let _e1328 = bitcast<i32>((bitcast<u32>(((_e1051[6] * _e1177) + 8388608f)) & 8388607u));
                    let _e1333 = (_e1309 + (select(1i, _e1328, (_e1328 > 1i)) & bitcast<i32>(_e1146)));
                    let _e1334 = bitcast<u32>(_e1333);
                    let _e1337 = (_e1313 ^ ((_e1334 ^ _e1313) & _e1318));
                    let _e1342 = (0u - select(0u, 1u, ((_e1333 <= _e1180) && (6i < _e1197))));
                    let _e1345 = (_e1321 ^ ((_e1334 ^ _e1321) & _e1342));
                    let _e1352 = bitcast<i32>((bitcast<u32>(((_e1051[7] * _e1177) + 8388608f)) & 8388607u));
                    let _e1357 = (_e1333 + (select(1i, _e1352, (_e1352 > 1i)) & bitcast<i32>(_e1153)));
                    let _e1358 = bitcast<u32>(_e1357);
                    let _e1361 = (_e1337 ^ ((_e1358 ^ _e1337) & _e1342));
                    let _e1366 = (0u - select(0u, 1u, ((_e1357 <= _e1180) && (7i < _e1197))));
                    let _e1369 = (_e1345 ^ ((_e1358 ^ _e1345) & _e1366));
                    let _e1372 = select(((((((((_e1201 & 1u) + (_e1222 & 1u)) + (_e1246 & 1u)) + (_e1270 & 1u)) + (_e1294 & 1u)) + (_e1318 & 1u)) + (_e1342 & 1u)) + (_e1366 & 1u)), _e1108, _e578.member_2.member_13);
                    let _e1377 = (_e1372 < 8u);
                    let _e1378 = ((_e1160 && (_e1361 > _e1369)) && _e1377);
                    let _e1379 = select(0u, _e1372, _e1377);
                    v58_2 = 0u;
                    if _e1378 {
                        v58_2 = (select(_e1361, _e578.member_2.member_8, (_e1372 == _e1156)) - _e1369);
                    }
                    let _e1383 = v58_2;
                    let _e1384 = (_e1379 < 8u);
                    if _e1384 {
                    } else {
                        v72_2 = true;
                        break;
                    }
                    let _e1388 = lightbvh_nodes.list[_e584][1u][_e1379];
                    let _e1389 = (_e1388 & 3u);
                    if _e1384 {
                    } else {
                        v72_2 = true;
                        break;
                    }
                    let _e1393 = lightbvh_nodes.list[_e584][5u][_e1379];
                    let _e1397 = ((_e583 && (_e1383 > 0u)) && (_e1383 <= _e578.member_2.member_8));
                    let _e1398 = select(1u, _e1383, _e1397);
                    let _e1400 = ((_e1398 - 1u) & 4194303u);
                    let _e1406 = (select((bitcast<u32>(31i) - firstLeadingBit(_e1400)), 32u, (_e1400 == 0u)) - 10u);
                    let _e1408 = select(22u, _e1406, (_e1406 < 22u));
                    let _e1421 = (_e1408 & 31u);
                    let _e1446 = LightbvhType32_(_e578.member, _e578.member_1, LightbvhType31_(_e578.member_2.member, LightbvhType23_((((_e578.member_2.member_1.member - (select(0u, _e1369, _e1378) << bitcast<u32>(10u))) << bitcast<u32>(_e1421)) | ((_e578.member_2.member_1.member_1 >> bitcast<u32>(1i)) >> bitcast<u32>(((31u - _e1408) & 31u)))), (_e578.member_2.member_1.member_1 << bitcast<u32>(_e1421))), _e578.member_2.member_2, _e578.member_2.member_3, _e578.member_2.member_4, _e578.member_2.member_5, _e578.member_2.member_6, _e578.member_2.member_7, _e578.member_2.member_8, _e578.member_2.member_9, _e578.member_2.member_10, _e578.member_2.member_11, _e578.member_2.member_12, _e578.member_2.member_13));
                    let _e1467 = LightbvhType32_(_e1446.member, _e1446.member_1, LightbvhType31_(_e1446.member_2.member, _e1446.member_2.member_1, _e1446.member_2.member_2, _e1446.member_2.member_3, _e1446.member_2.member_4, _e1446.member_2.member_5, _e1446.member_2.member_6, _e1446.member_2.member_7, (_e1398 << bitcast<u32>(_e1421)), _e1446.member_2.member_9, _e1446.member_2.member_10, _e1446.member_2.member_11, _e1446.member_2.member_12, _e1446.member_2.member_13));
                    let _e1489 = LightbvhType32_(_e1467.member, _e1467.member_1, LightbvhType31_(_e1467.member_2.member, _e1467.member_2.member_1, _e1467.member_2.member_2, _e1467.member_2.member_3, _e1467.member_2.member_4, _e1467.member_2.member_5, _e1467.member_2.member_6, _e1467.member_2.member_7, _e1467.member_2.member_8, (_e578.member_2.member_9 + _e1408), _e1467.member_2.member_10, _e1467.member_2.member_11, _e1467.member_2.member_12, _e1467.member_2.member_13));
                    let _e1490 = (_e578.member_2.member_7 + 1u);
                    v59_2 = true;
                    if (_e1490 == 20u) {
                    } else {
                        v59_2 = (_e1490 == 40u);
                    }
                    let _e1494 = v59_2;
                    let _e1495 = (_e1393 & 134217727u);
                    let _e1499 = (_e1393 >> bitcast<u32>((firstTrailingBit(134217728u) & 31u)));
                    let _e1503 = (_e1495 < _e151);
                    let _e1504 = (((_e1397 && (_e1389 == 3u)) && _e1073) && _e1503);
                    let _e1508 = ((_e1397 && (_e1389 == 1u)) && !(_e1494));
                    let _e1530 = LightbvhType32_(_e1489.member, _e1489.member_1, LightbvhType31_(_e1489.member_2.member, _e1489.member_2.member_1, _e1489.member_2.member_2, _e1489.member_2.member_3, _e1489.member_2.member_4, select(4294967295u, _e1393, (_e1397 && (_e1389 == 2u))), _e1489.member_2.member_6, _e1489.member_2.member_7, _e1489.member_2.member_8, _e1489.member_2.member_9, _e1489.member_2.member_10, _e1489.member_2.member_11, _e1489.member_2.member_12, _e1489.member_2.member_13));
                    let _e1533 = (_e578.member_2.member_11 - 1u);
                    let _e1552 = LightbvhType32_(_e1530.member, _e1530.member_1, LightbvhType31_(_e1530.member_2.member, _e1530.member_2.member_1, _e1530.member_2.member_2, _e1530.member_2.member_3, _e1530.member_2.member_4, _e1530.member_2.member_5, _e1530.member_2.member_6, _e1530.member_2.member_7, _e1530.member_2.member_8, _e1530.member_2.member_9, _e1530.member_2.member_10, _e1533, _e1530.member_2.member_12, _e1530.member_2.member_13));
                    let _e1556 = (!((_e1504 || _e1508)) || (_e1533 == 0u));
                    let _e1575 = LightbvhType32_(_e1552.member, _e1552.member_1, LightbvhType31_(_e1552.member_2.member, _e1552.member_2.member_1, _e1552.member_2.member_2, _e1552.member_2.member_3, _e1552.member_2.member_4, _e1552.member_2.member_5, _e1552.member_2.member_6, _e1552.member_2.member_7, _e1552.member_2.member_8, _e1552.member_2.member_9, _e1552.member_2.member_10, _e1552.member_2.member_11, _e1556, _e1552.member_2.member_13));
                    v60_2 = LightbvhType32_();
                    if _e1504 {
                        if _e1503 {
                        } else {
                            v72_2 = true;
                            break;
                        }
                        let _e1640 = LightbvhType32_(_e1575.member, _e1575.member_1, LightbvhType31_(_e1575.member_2.member, _e1575.member_2.member_1, _e1575.member_2.member_2, _e1575.member_2.member_3, _e1575.member_2.member_4, _e1575.member_2.member_5, _e1495, _e1575.member_2.member_7, _e1575.member_2.member_8, _e1575.member_2.member_9, _e1575.member_2.member_10, _e1575.member_2.member_11, _e1575.member_2.member_12, _e1575.member_2.member_13));
                        let _e1643 = lightbvh_instances.list[_e1495].root;
                        let _e1662 = LightbvhType32_(_e1640.member, _e1640.member_1, LightbvhType31_(_e1640.member_2.member, _e1640.member_2.member_1, _e1640.member_2.member_2, _e1640.member_2.member_3, _e1643, _e1640.member_2.member_5, _e1640.member_2.member_6, _e1640.member_2.member_7, _e1640.member_2.member_8, _e1640.member_2.member_9, _e1640.member_2.member_10, _e1640.member_2.member_11, _e1640.member_2.member_12, _e1640.member_2.member_13));
                        let _e1663 = (_e1643 == 4294967295u);
                        v62_2 = 4294967295u;
                        if _e1663 {
                            let _e1666 = lightbvh_instances.list[_e1495].first_light;
                            v62_2 = _e1666;
                        }
                        let _e1668 = v62_2;
                        let _e1687 = LightbvhType32_(_e1662.member, _e1662.member_1, LightbvhType31_(_e1662.member_2.member, _e1662.member_2.member_1, _e1662.member_2.member_2, _e1662.member_2.member_3, _e1662.member_2.member_4, _e1668, _e1662.member_2.member_6, _e1662.member_2.member_7, _e1662.member_2.member_8, _e1662.member_2.member_9, _e1662.member_2.member_10, _e1662.member_2.member_11, _e1662.member_2.member_12, _e1662.member_2.member_13));
                        let _e1688 = (_e1556 || _e1663);
                        let _e1707 = LightbvhType32_(_e1687.member, _e1687.member_1, LightbvhType31_(_e1687.member_2.member, _e1687.member_2.member_1, _e1687.member_2.member_2, _e1687.member_2.member_3, _e1687.member_2.member_4, _e1687.member_2.member_5, _e1687.member_2.member_6, _e1687.member_2.member_7, _e1687.member_2.member_8, _e1687.member_2.member_9, _e1687.member_2.member_10, _e1687.member_2.member_11, _e1688, _e1687.member_2.member_13));
                        let _e1726 = LightbvhType32_(_e1707.member, _e1707.member_1, LightbvhType31_(_e1707.member_2.member, _e1707.member_2.member_1, _e1707.member_2.member_2, _e1707.member_2.member_3, _e1707.member_2.member_4, _e1707.member_2.member_5, _e1707.member_2.member_6, 20u, _e1707.member_2.member_8, _e1707.member_2.member_9, _e1707.member_2.member_10, _e1707.member_2.member_11, _e1707.member_2.member_12, _e1707.member_2.member_13));
                        v63_2 = _e1726;
                        if (_e1499 > 0u) {
                            let _e1729 = select(0u, _e1643, (_e1643 < _e148));
                            if (_e1729 < _e148) {
                            } else {
                                v72_2 = true;
                                break;
                            }
                            let _e1732 = ((_e1499 - 1u) % 8u);
                            let _e1733 = (_e1732 < 8u);
                            if _e1733 {
                            } else {
                                v72_2 = true;
                                break;
                            }
                            let _e1737 = lightbvh_nodes.list[_e1729][1u][_e1732];
                            let _e1738 = (_e1737 & 3u);
                            if _e1733 {
                            } else {
                                v72_2 = true;
                                break;
                            }
                            let _e1742 = lightbvh_nodes.list[_e1729][5u][_e1732];
                            let _e1761 = LightbvhType32_(_e1726.member, _e1726.member_1, LightbvhType31_(_e1726.member_2.member, _e1726.member_2.member_1, _e1726.member_2.member_2, _e1726.member_2.member_3, _e1742, _e1726.member_2.member_5, _e1726.member_2.member_6, _e1726.member_2.member_7, _e1726.member_2.member_8, _e1726.member_2.member_9, _e1726.member_2.member_10, _e1726.member_2.member_11, _e1726.member_2.member_12, _e1726.member_2.member_13));
                            let _e1782 = LightbvhType32_(_e1761.member, _e1761.member_1, LightbvhType31_(_e1761.member_2.member, _e1761.member_2.member_1, _e1761.member_2.member_2, _e1761.member_2.member_3, _e1761.member_2.member_4, select(4294967295u, _e1742, (_e1738 == 2u)), _e1761.member_2.member_6, _e1761.member_2.member_7, _e1761.member_2.member_8, _e1761.member_2.member_9, _e1761.member_2.member_10, _e1761.member_2.member_11, _e1761.member_2.member_12, _e1761.member_2.member_13));
                            let _e1803 = LightbvhType32_(_e1782.member, _e1782.member_1, LightbvhType31_(_e1782.member_2.member, _e1782.member_2.member_1, _e1782.member_2.member_2, _e1782.member_2.member_3, _e1782.member_2.member_4, _e1782.member_2.member_5, _e1782.member_2.member_6, _e1782.member_2.member_7, _e1782.member_2.member_8, _e1782.member_2.member_9, _e1782.member_2.member_10, _e1782.member_2.member_11, (_e1688 || (_e1738 != 1u)), _e1782.member_2.member_13));
                            v63_2 = LightbvhType32_(_e1803.member, _e1803.member_1, LightbvhType31_(_e1803.member_2.member, _e1803.member_2.member_1, _e1803.member_2.member_2, _e1803.member_2.member_3, _e1803.member_2.member_4, _e1803.member_2.member_5, _e1803.member_2.member_6, 21u, _e1803.member_2.member_8, _e1803.member_2.member_9, _e1803.member_2.member_10, _e1803.member_2.member_11, _e1803.member_2.member_12, _e1803.member_2.member_13));
                        }
                        let _e1824 = v63_2;
                        let _e1833 = lightbvh_instances.list[_e1495].translation[0u];
                        let _e1837 = lightbvh_instances.list[_e1495].translation[1u];
                        let _e1841 = lightbvh_instances.list[_e1495].translation[2u];
                        let _e1842 = (_e183.member.member[0] - _e1833);
                        let _e1843 = (_e183.member.member[1] - _e1837);
                        let _e1844 = (_e183.member.member[2] - _e1841);
                        let _e1849 = select(_e1842, 0f, (bitcast<f32>((bitcast<u32>(_e1842) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1854 = select(_e1843, 0f, (bitcast<f32>((bitcast<u32>(_e1843) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1859 = select(_e1844, 0f, (bitcast<f32>((bitcast<u32>(_e1844) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1864 = lightbvh_instances.list[_e1495].inverse[0u][0u];
                        let _e1869 = lightbvh_instances.list[_e1495].inverse[0u][1u];
                        let _e1874 = lightbvh_instances.list[_e1495].inverse[0u][2u];
                        let _e1882 = lightbvh_instances.list[_e1495].inverse[1u][0u];
                        let _e1887 = lightbvh_instances.list[_e1495].inverse[1u][1u];
                        let _e1892 = lightbvh_instances.list[_e1495].inverse[1u][2u];
                        let _e1903 = lightbvh_instances.list[_e1495].inverse[2u][0u];
                        let _e1908 = lightbvh_instances.list[_e1495].inverse[2u][1u];
                        let _e1913 = lightbvh_instances.list[_e1495].inverse[2u][2u];
                        let _e1917 = (((_e1864 * _e1849) + (_e1882 * _e1854)) + (_e1903 * _e1859));
                        let _e1918 = (((_e1869 * _e1849) + (_e1887 * _e1854)) + (_e1908 * _e1859));
                        let _e1919 = (((_e1874 * _e1849) + (_e1892 * _e1854)) + (_e1913 * _e1859));
                        let _e1927 = lightbvh_instances.list[_e1495].columns[0u][0u];
                        let _e1932 = lightbvh_instances.list[_e1495].columns[0u][1u];
                        let _e1937 = lightbvh_instances.list[_e1495].columns[0u][2u];
                        let _e1942 = (((_e1927 * _e183.member.member_2[0]) + (_e1932 * _e183.member.member_2[1])) + (_e1937 * _e183.member.member_2[2]));
                        let _e1947 = lightbvh_instances.list[_e1495].columns[1u][0u];
                        let _e1952 = lightbvh_instances.list[_e1495].columns[1u][1u];
                        let _e1957 = lightbvh_instances.list[_e1495].columns[1u][2u];
                        let _e1962 = (((_e1947 * _e183.member.member_2[0]) + (_e1952 * _e183.member.member_2[1])) + (_e1957 * _e183.member.member_2[2]));
                        let _e1967 = lightbvh_instances.list[_e1495].columns[2u][0u];
                        let _e1972 = lightbvh_instances.list[_e1495].columns[2u][1u];
                        let _e1977 = lightbvh_instances.list[_e1495].columns[2u][2u];
                        let _e1982 = (((_e1967 * _e183.member.member_2[0]) + (_e1972 * _e183.member.member_2[1])) + (_e1977 * _e183.member.member_2[2]));
                        let _e1987 = select(_e1942, 0f, (bitcast<f32>((bitcast<u32>(_e1942) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1992 = select(_e1962, 0f, (bitcast<f32>((bitcast<u32>(_e1962) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1997 = select(_e1982, 0f, (bitcast<f32>((bitcast<u32>(_e1982) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e2002 = (((_e1987 * _e1987) + (_e1992 * _e1992)) + (_e1997 * _e1997));
                        let _e2003 = bitcast<f32>(67108864u);
                        v64_2 = 0f;
                        if (_e2002 >= _e2003) {
                            let _e2009 = bitcast<f32>((1597463007u - (bitcast<u32>(_e2002) >> bitcast<u32>(1i))));
                            let _e2010 = (0.5f * _e2002);
                            let _e2014 = (_e2009 * (1.5f - ((_e2010 * _e2009) * _e2009)));
                            v64_2 = (_e2014 * (1.5f - ((_e2010 * _e2014) * _e2014)));
                        }
                        let _e2020 = v64_2;
                        let _e2021 = -(1152921500000000000f);
                        v65_2 = _e2021;
                        if (_e1917 < _e2021) {
                        } else {
                            v65_2 = select(_e1917, 1152921500000000000f, (_e1917 > 1152921500000000000f));
                        }
                        let _e2026 = v65_2;
                        v66_2 = _e2021;
                        if (_e1918 < _e2021) {
                        } else {
                            v66_2 = select(_e1918, 1152921500000000000f, (_e1918 > 1152921500000000000f));
                        }
                        let _e2036 = v66_2;
                        v67_2 = _e2021;
                        if (_e1919 < _e2021) {
                        } else {
                            v67_2 = select(_e1919, 1152921500000000000f, (_e1919 > 1152921500000000000f));
                        }
                        let _e2046 = v67_2;
                        let _e2053 = (_e1987 * _e2020);
                        let _e2059 = (_e1992 * _e2020);
                        let _e2065 = (_e1997 * _e2020);
                        let _e2081 = select(_e183.member.member_2[0], 0f, (bitcast<f32>((bitcast<u32>(_e183.member.member_2[0]) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e2086 = select(_e183.member.member_2[1], 0f, (bitcast<f32>((bitcast<u32>(_e183.member.member_2[1]) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e2091 = select(_e183.member.member_2[2], 0f, (bitcast<f32>((bitcast<u32>(_e183.member.member_2[2]) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e2096 = (((_e2081 * _e2081) + (_e2086 * _e2086)) + (_e2091 * _e2091));
                        let _e2098 = select(_e2003, _e2096, (_e2096 > _e2003));
                        let _e2103 = bitcast<f32>((1597463007u - (bitcast<u32>(_e2098) >> bitcast<u32>(1i))));
                        let _e2104 = (0.5f * _e2098);
                        let _e2108 = (_e2103 * (1.5f - ((_e2104 * _e2103) * _e2103)));
                        let _e2113 = (_e2098 * (_e2108 * (1.5f - ((_e2104 * _e2108) * _e2108))));
                        let _e2114 = (select(_e2053, 0f, (bitcast<f32>((bitcast<u32>(_e2053) & 2147483647u)) < 0.00000000000000000086736174f)) * _e2113);
                        let _e2115 = (select(_e2059, 0f, (bitcast<f32>((bitcast<u32>(_e2059) & 2147483647u)) < 0.00000000000000000086736174f)) * _e2113);
                        let _e2116 = (select(_e2065, 0f, (bitcast<f32>((bitcast<u32>(_e2065) & 2147483647u)) < 0.00000000000000000086736174f)) * _e2113);
                        let _e2142 = select(_e183.member.member_1[0], 0f, (bitcast<f32>((bitcast<u32>(_e183.member.member_1[0]) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e2147 = select(_e183.member.member_1[1], 0f, (bitcast<f32>((bitcast<u32>(_e183.member.member_1[1]) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e2152 = select(_e183.member.member_1[2], 0f, (bitcast<f32>((bitcast<u32>(_e183.member.member_1[2]) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e2192 = (((bitcast<f32>((bitcast<u32>(_e1864) & 2147483647u)) * _e2142) + (bitcast<f32>((bitcast<u32>(_e1882) & 2147483647u)) * _e2147)) + (bitcast<f32>((bitcast<u32>(_e1903) & 2147483647u)) * _e2152));
                        let _e2193 = (((bitcast<f32>((bitcast<u32>(_e1869) & 2147483647u)) * _e2142) + (bitcast<f32>((bitcast<u32>(_e1887) & 2147483647u)) * _e2147)) + (bitcast<f32>((bitcast<u32>(_e1908) & 2147483647u)) * _e2152));
                        let _e2194 = (((bitcast<f32>((bitcast<u32>(_e1874) & 2147483647u)) * _e2142) + (bitcast<f32>((bitcast<u32>(_e1892) & 2147483647u)) * _e2147)) + (bitcast<f32>((bitcast<u32>(_e1913) & 2147483647u)) * _e2152));
                        let _e2196 = select(1152921500000000000f, _e2192, (_e2192 < 1152921500000000000f));
                        let _e2198 = select(1152921500000000000f, _e2193, (_e2193 < 1152921500000000000f));
                        let _e2200 = select(1152921500000000000f, _e2194, (_e2194 < 1152921500000000000f));
                        v60_2 = LightbvhType32_(_e1824.member, _e1824.member_1, LightbvhType31_(_e1824.member_2.member, _e1824.member_2.member_1, _e1824.member_2.member_2, _e1824.member_2.member_3, _e1824.member_2.member_4, _e1824.member_2.member_5, _e1824.member_2.member_6, _e1824.member_2.member_7, _e1824.member_2.member_8, _e1824.member_2.member_9, LightbvhType29_(array<f32, 3>(select(_e2026, 0f, (bitcast<f32>((bitcast<u32>(_e2026) & 2147483647u)) < 0.00000000000000000086736174f)), select(_e2036, 0f, (bitcast<f32>((bitcast<u32>(_e2036) & 2147483647u)) < 0.00000000000000000086736174f)), select(_e2046, 0f, (bitcast<f32>((bitcast<u32>(_e2046) & 2147483647u)) < 0.00000000000000000086736174f))), array<f32, 3>(select(_e2196, 0f, (bitcast<f32>((bitcast<u32>(_e2196) & 2147483647u)) < 0.00000000000000000086736174f)), select(_e2198, 0f, (bitcast<f32>((bitcast<u32>(_e2198) & 2147483647u)) < 0.00000000000000000086736174f)), select(_e2200, 0f, (bitcast<f32>((bitcast<u32>(_e2200) & 2147483647u)) < 0.00000000000000000086736174f))), array<f32, 3>(select(_e2114, 0f, (bitcast<f32>((bitcast<u32>(_e2114) & 2147483647u)) < 0.00000000000000000086736174f)), select(_e2115, 0f, (bitcast<f32>((bitcast<u32>(_e2115) & 2147483647u)) < 0.00000000000000000086736174f)), select(_e2116, 0f, (bitcast<f32>((bitcast<u32>(_e2116) & 2147483647u)) < 0.00000000000000000086736174f)))), _e1824.member_2.member_11, _e1824.member_2.member_12, _e1824.member_2.member_13));
                    }
                    let _e1577 = v60_2;
                    v68_2 = _e1577;
                    if _e1504 {
                    } else {
                        v61_2 = _e578.member_2.member_4;
                        if _e1508 {
                            v61_2 = (_e1393 + select(0u, _e157, _e1073));
                        }
                        let _e1581 = v61_2;
                        let _e1600 = LightbvhType32_(_e1575.member, _e1575.member_1, LightbvhType31_(_e1575.member_2.member, _e1575.member_2.member_1, _e1575.member_2.member_2, _e1575.member_2.member_3, _e1581, _e1575.member_2.member_5, _e1575.member_2.member_6, _e1575.member_2.member_7, _e1575.member_2.member_8, _e1575.member_2.member_9, _e1575.member_2.member_10, _e1575.member_2.member_11, _e1575.member_2.member_12, _e1575.member_2.member_13));
                        v68_2 = LightbvhType32_(_e1600.member, _e1600.member_1, LightbvhType31_(_e1600.member_2.member, _e1600.member_2.member_1, _e1600.member_2.member_2, _e1600.member_2.member_3, _e1600.member_2.member_4, _e1600.member_2.member_5, _e1600.member_2.member_6, (_e578.member_2.member_7 + select(0u, 1u, _e1508)), _e1600.member_2.member_8, _e1600.member_2.member_9, _e1600.member_2.member_10, _e1600.member_2.member_11, _e1600.member_2.member_12, _e1600.member_2.member_13));
                    }
                    let _e2239 = v68_2;
                    v69_2 = _e1050;
                    v70_2 = _e2239;
                    v71_2 = _e2239.member_2.member_12;
                }
                let _e2243 = v69_2;
                let _e2245 = v70_2;
                let _e2247 = v71_2;
                continue;
                continuing {
                    v44_2 = _e2243;
                    v45_2 = _e2245;
                    v46_2 = _e2247;
                    v72_2 = _e2243;
                    break if !(select(true, false, _e580));
                }
            }
            let _e2251 = v72_2;
            if _e2251 {
                break;
            }
            let _e2253 = v73_2;
            let _e2255 = (_e2253.member != 4294967295u);
            let _e2257 = v74_2;
            let _e2263 = v75_2;
            let _e2267 = v76_2;
            let _e2271 = ((_e2257.member_2.member_5 != 4294967295u) && (!(_e2255) || (_e2263.member_2.member_6 == _e2267.member_1)));
            let _e2272 = select(_e2263.member_2.member_6, _e2267.member_1, _e2255);
            v78_2 = _e2253.member;
            if _e2255 {
            } else {
                let _e2273 = (_e2263.member_2.member_6 < _e151);
                v77_2 = _e2257.member_2.member_5;
                if _e2273 {
                    if _e2273 {
                    } else {
                        break;
                    }
                    let _e2276 = lightbvh_instances.list[_e2263.member_2.member_6].first_light;
                    let _e2280 = lightbvh_instances.list[_e2263.member_2.member_6].first;
                    v77_2 = ((_e2257.member_2.member_5 - _e2276) + _e2280);
                }
                let _e2283 = v77_2;
                v78_2 = _e2283;
            }
            let _e2285 = v78_2;
            v81_2 = 0f;
            if _e2271 {
                let _e2287 = v79_2;
                let _e2293 = v80_2;
                let _e2300 = -(bitcast<i32>((22u + select(98u, _e2287.member_2.member_9, (_e2287.member_2.member_9 < 98u)))));
                let _e2302 = select(_e2300, -126i, (_e2300 < -126i));
                v81_2 = (f32(bitcast<i32>(_e2293.member_2.member_8)) * bitcast<f32>((bitcast<u32>((select(_e2302, 127i, (_e2302 > 127i)) + 127i)) << bitcast<u32>(23i))));
            }
            let _e2312 = v81_2;
            v83_2 = u32();
            v84_2 = true;
            if (_e175 > 0u) {
                let _e2314 = (_e2272 < _e151);
                v82_2 = u32();
                if _e2314 {
                    if _e2314 {
                    } else {
                        break;
                    }
                    let _e2317 = lightbvh_instances.list[_e2272].count;
                    v82_2 = _e2317;
                }
                let _e2319 = v82_2;
                v83_2 = _e2319;
                v84_2 = select(true, false, _e2314);
            }
            let _e2322 = v83_2;
            let _e2324 = v84_2;
            let _e2329 = (select(_e2322, _e178, _e2324) & 2147483647u);
            let _e2334 = bitcast<u32>((f32(65536i) * bitcast<f32>(880803840u)));
            let _e2335 = bitcast<u32>(f32(bitcast<i32>(select(1u, _e2329, (_e2329 > 0u)))));
            let _e2340 = ((_e2334 >> bitcast<u32>(23i)) & 255u);
            let _e2344 = (_e2334 & 8388607u);
            let _e2345 = (_e2344 | 8388608u);
            let _e2346 = (_e2335 & 8388607u);
            let _e2347 = (_e2346 | 8388608u);
            let _e2348 = (_e2345 < _e2347);
            let _e2352 = bitcast<f32>((_e2346 | 1065353216u));
            let _e2353 = bitcast<u32>(_e2352);
            let _e2358 = bitcast<f32>(((_e2353 & 2147483648u) | (2129859015u - (_e2353 & 2147483647u))));
            let _e2361 = (_e2358 * (2f - (_e2352 * _e2358)));
            let _e2364 = (_e2361 * (2f - (_e2352 * _e2361)));
            let _e2368 = ((bitcast<f32>((_e2344 | 1065353216u)) * _e2364) * select(8388608f, 16777216f, _e2348));
            let _e2369 = bitcast<f32>(0u);
            let _e2370 = bitcast<f32>(1333788671u);
            let _e2375 = select(select(u32(_e2368), 0u, (_e2368 < _e2369)), 4294967295u, (_e2368 > _e2370));
            let _e2381 = bitcast<i32>(((_e2345 << bitcast<u32>((select(23i, 24i, _e2348) & 31i))) - (_e2375 * _e2347)));
            let _e2386 = ((f32((_e2381 >> bitcast<u32>(8i))) * _e2364) * 0.000030517578f);
            let _e2387 = bitcast<f32>(3472883712u);
            let _e2388 = bitcast<f32>(1325400063u);
            let _e2395 = select(0i, select(select(i32(_e2386), i32(-2147483648), (_e2386 < _e2387)), 2147483647i, (_e2386 > _e2388)), (_e2386 == _e2386));
            let _e2397 = (_e2375 + bitcast<u32>(_e2395));
            let _e2398 = bitcast<i32>(_e2347);
            let _e2400 = (_e2381 - (_e2395 * _e2398));
            let _e2401 = (_e2400 < 0i);
            v85_2 = _e2397;
            if _e2401 {
                v85_2 = (_e2397 - 1u);
            }
            let _e2404 = v85_2;
            v86_2 = _e2400;
            if _e2401 {
                v86_2 = (_e2400 + _e2398);
            }
            let _e2407 = v86_2;
            let _e2408 = (_e2407 >= _e2398);
            v87_2 = _e2404;
            if _e2408 {
                v87_2 = (_e2404 + 1u);
            }
            let _e2411 = v87_2;
            v88_2 = _e2407;
            if _e2408 {
                v88_2 = (_e2407 - _e2398);
            }
            let _e2414 = v88_2;
            v89_1 = _e2411;
            if ((_e2414 * 2i) > _e2398) {
                v89_1 = (_e2411 + 1u);
            }
            let _e2419 = v89_1;
            let _e2424 = ((bitcast<i32>(_e2340) - bitcast<i32>(((_e2335 >> bitcast<u32>(23i)) & 255u))) + select(127i, 126i, _e2348));
            v92_1 = u32();
            v93_1 = true;
            if (_e2340 == 0u) {
            } else {
                let _e2426 = (_e2424 <= 0i);
                v91_1 = u32();
                if _e2426 {
                } else {
                    v90_1 = 2139095040u;
                    if (_e2424 >= 255i) {
                    } else {
                        v90_1 = ((bitcast<u32>(_e2424) << bitcast<u32>(23i)) + (_e2419 & 8388607u));
                    }
                    let _e2434 = v90_1;
                    v91_1 = _e2434;
                }
                let _e2436 = v91_1;
                v92_1 = _e2436;
                v93_1 = _e2426;
            }
            let _e2438 = v92_1;
            let _e2440 = v93_1;
            let _e2444 = (_e175 & 2147483647u);
            let _e2449 = bitcast<u32>(bitcast<f32>((((_e2334 ^ _e2335) & 2147483648u) | select(_e2438, 0u, _e2440))));
            let _e2450 = bitcast<u32>(f32(bitcast<i32>(select(1u, _e2444, (_e2444 > 0u)))));
            let _e2455 = ((_e2449 >> bitcast<u32>(23i)) & 255u);
            let _e2459 = (_e2449 & 8388607u);
            let _e2460 = (_e2459 | 8388608u);
            let _e2461 = (_e2450 & 8388607u);
            let _e2462 = (_e2461 | 8388608u);
            let _e2463 = (_e2460 < _e2462);
            let _e2467 = bitcast<f32>((_e2461 | 1065353216u));
            let _e2468 = bitcast<u32>(_e2467);
            let _e2473 = bitcast<f32>(((_e2468 & 2147483648u) | (2129859015u - (_e2468 & 2147483647u))));
            let _e2476 = (_e2473 * (2f - (_e2467 * _e2473)));
            let _e2479 = (_e2476 * (2f - (_e2467 * _e2476)));
            let _e2483 = ((bitcast<f32>((_e2459 | 1065353216u)) * _e2479) * select(8388608f, 16777216f, _e2463));
            let _e2488 = select(select(u32(_e2483), 0u, (_e2483 < _e2369)), 4294967295u, (_e2483 > _e2370));
            let _e2494 = bitcast<i32>(((_e2460 << bitcast<u32>((select(23i, 24i, _e2463) & 31i))) - (_e2488 * _e2462)));
            let _e2499 = ((f32((_e2494 >> bitcast<u32>(8i))) * _e2479) * 0.000030517578f);
            let _e2506 = select(0i, select(select(i32(_e2499), i32(-2147483648), (_e2499 < _e2387)), 2147483647i, (_e2499 > _e2388)), (_e2499 == _e2499));
            let _e2508 = (_e2488 + bitcast<u32>(_e2506));
            let _e2509 = bitcast<i32>(_e2462);
            let _e2511 = (_e2494 - (_e2506 * _e2509));
            let _e2512 = (_e2511 < 0i);
            v94_1 = _e2508;
            if _e2512 {
                v94_1 = (_e2508 - 1u);
            }
            let _e2515 = v94_1;
            v95_1 = _e2511;
            if _e2512 {
                v95_1 = (_e2511 + _e2509);
            }
            let _e2518 = v95_1;
            let _e2519 = (_e2518 >= _e2509);
            v96_1 = _e2515;
            if _e2519 {
                v96_1 = (_e2515 + 1u);
            }
            let _e2522 = v96_1;
            v97_1 = _e2518;
            if _e2519 {
                v97_1 = (_e2518 - _e2509);
            }
            let _e2525 = v97_1;
            v98_1 = _e2522;
            if ((_e2525 * 2i) > _e2509) {
                v98_1 = (_e2522 + 1u);
            }
            let _e2530 = v98_1;
            let _e2535 = ((bitcast<i32>(_e2455) - bitcast<i32>(((_e2450 >> bitcast<u32>(23i)) & 255u))) + select(127i, 126i, _e2463));
            v101_1 = u32();
            v102_1 = true;
            if (_e2455 == 0u) {
            } else {
                let _e2537 = (_e2535 <= 0i);
                v100_1 = u32();
                if _e2537 {
                } else {
                    v99_1 = 2139095040u;
                    if (_e2535 >= 255i) {
                    } else {
                        v99_1 = ((bitcast<u32>(_e2535) << bitcast<u32>(23i)) + (_e2530 & 8388607u));
                    }
                    let _e2545 = v99_1;
                    v100_1 = _e2545;
                }
                let _e2547 = v100_1;
                v101_1 = _e2547;
                v102_1 = _e2537;
            }
            let _e2549 = v101_1;
            let _e2551 = v102_1;
            v103_1 = LightbvhType19_(4294967295u, 4294967295u, 0f);
            if (_e2255 || _e2271) {
                v103_1 = LightbvhType19_(_e2285, _e2272, (_e2312 + bitcast<f32>((((_e2449 ^ _e2450) & 2147483648u) | select(_e2549, 0u, _e2551)))));
            }
            let _e2559 = v103_1;
            results_2 = _e2559;
            break;
        }
    }
    let _e2665 = results_2;
    return LightbvhLightSample(_e2665.member, _e2665.member_1, _e2665.member_2);
}

fn lightbvh_pmf_cell(center_1: vec3<f32>, half_1: vec3<f32>, n_3: vec3<f32>, light_1: u32, instance_1: u32) -> f32 {
    var queries_3: LightbvhType30_;
    var results_3: f32;
    var v0_3: array<f32, 8>;
    var v1_3: u32;
    var v2_3: u32;
    var v3_3: bool;
    var v4_3: u32;
    var v5_3: u32;
    var v6_3: u32;
    var v7_3: bool;
    var v8_3: bool;
    var v9_3: LightbvhType24_;
    var v10_3: u32;
    var v11_3: u32;
    var v12_3: u32;
    var v13_3: u32;
    var v14_3: bool;
    var v15_3: u32;
    var v16_3: LightbvhType23_;
    var v17_3: u32;
    var v18_3: u32;
    var v19_3: u32;
    var v20_3: LightbvhType23_;
    var v21_3: u32;
    var v22_3: u32;
    var v23_3: LightbvhType23_;
    var v24_3: u32;
    var v25_3: bool;
    var v26_3: bool;
    var v27_3: LightbvhType23_;
    var v28_3: bool;
    var v29_3: LightbvhType24_;
    var v30_3: bool;
    var v31_3: LightbvhType31_;
    var v32_3: bool;
    var v33_3: LightbvhType23_;
    var v34_3: LightbvhType23_;
    var v35_3: LightbvhType23_;
    var v36_3: LightbvhType23_;
    var v37_3: LightbvhType23_;
    var v38_3: bool;
    var v39_3: u32;
    var v40_3: u32;
    var v41_3: u32;
    var v42_3: u32;
    var v43_3: i32;
    var v44_3: u32;
    var v45_3: bool;
    var v46_3: LightbvhType31_;
    var v47_3: u32;
    var v48_3: u32;
    var v49_3: LightbvhType31_;
    var v50_3: f32;
    var v51_3: f32;
    var v52_3: f32;
    var v53_3: f32;
    var v54_3: LightbvhType31_;
    var v55_3: bool;
    var v56_3: LightbvhType31_;
    var v57_3: bool;
    var v58_3: bool;
    var v59_3: LightbvhType31_;
    var v60_3: LightbvhType31_;
    var v61_3: LightbvhType31_;
    var v62_3: LightbvhType31_;
    var v63_3: f32;
    var v64_3: u32;
    var v65_3: u32;
    var v66_3: bool;
    var v67_3: u32;
    var v68_3: i32;
    var v69_3: u32;
    var v70_3: i32;
    var v71_3: u32;
    var v72_3: u32;
    var v73_3: u32;
    var v74_3: u32;
    var v75_3: bool;
    var v76_3: u32;
    var v77_3: i32;
    var v78_3: u32;
    var v79_3: i32;
    var v80_3: u32;
    var v81_3: u32;
    var v82_3: u32;
    var v83_3: u32;
    var v84_3: bool;
    var v85_3: bool;
    var v86_3: bool;
    var v87_3: bool;
    var v88_3: f32;

    queries_3 = LightbvhType30_(LightbvhType29_(array<f32, 3>(center_1.x, center_1.y, center_1.z), array<f32, 3>(half_1.x, half_1.y, half_1.z), array<f32, 3>(n_3.x, n_3.y, n_3.z)), array<u32, 2>(light_1, instance_1));
    switch bitcast<i32>(0u) {
        default: {
            let _e142 = arrayLength((&lightbvh_nodes.list));
            let _e145 = arrayLength((&lightbvh_instances.list));
            let _e148 = arrayLength((&lightbvh_trails.list));
            let _e151 = lightbvh_tree.top;
            let _e154 = lightbvh_tree.root;
            let _e157 = lightbvh_tree.above;
            let _e160 = lightbvh_tree.places;
            let _e163 = lightbvh_tree.parts;
            let _e166 = lightbvh_tree.trail_words;
            let _e169 = lightbvh_tree.live;
            let _e172 = lightbvh_tree.lights;
            let _e175 = lightbvh_tree.depth;
            let _e177 = queries_3;
            let _e183 = (_e169 > 0u);
            let _e184 = select(4294967295u, _e177.member_1[1], _e183);
            let _e185 = (_e184 < _e145);
            v2_3 = u32();
            v3_3 = true;
            if _e185 {
                v1_3 = u32();
                if _e183 {
                    if _e185 {
                    } else {
                        break;
                    }
                    let _e188 = lightbvh_instances.list[_e184].first;
                    let _e192 = lightbvh_instances.list[_e184].first_light;
                    v1_3 = ((_e177.member_1[0] - _e188) + _e192);
                }
                let _e195 = v1_3;
                v2_3 = _e195;
                v3_3 = select(true, false, _e183);
            }
            let _e198 = v2_3;
            let _e200 = v3_3;
            let _e201 = select(_e198, _e177.member_1[0], _e200);
            let _e202 = (_e201 * _e166);
            let _e203 = (_e202 < _e148);
            v4_3 = 0u;
            if _e203 {
                if _e203 {
                } else {
                    break;
                }
                let _e205 = lightbvh_trails.list[_e202];
                v4_3 = _e205;
            }
            let _e207 = v4_3;
            v6_3 = u32();
            v7_3 = true;
            if (_e166 == 2u) {
                let _e209 = (_e202 + 1u);
                let _e210 = (_e209 < _e148);
                v5_3 = u32();
                if _e210 {
                    if _e210 {
                    } else {
                        break;
                    }
                    let _e212 = lightbvh_trails.list[_e209];
                    v5_3 = _e212;
                }
                let _e214 = v5_3;
                v6_3 = _e214;
                v7_3 = select(true, false, _e210);
            }
            let _e217 = v6_3;
            let _e219 = v7_3;
            let _e220 = select(_e217, 0u, _e219);
            v8_3 = bool();
            v9_3 = LightbvhType24_();
            if _e185 {
                let _e227 = (_e160 + _e184);
                let _e228 = (_e227 < _e148);
                v10_3 = 4294967295u;
                if _e228 {
                    if _e228 {
                    } else {
                        break;
                    }
                    let _e230 = lightbvh_trails.list[_e227];
                    v10_3 = _e230;
                }
                let _e232 = v10_3;
                v13_3 = u32();
                v14_3 = true;
                if (_e232 != 4294967295u) {
                    let _e234 = (_e232 >= 2147483648u);
                    v12_3 = u32();
                    if _e234 {
                        let _e238 = (_e163 + ((_e232 - 2147483648u) + (_e207 & 7u)));
                        let _e239 = (_e238 < _e148);
                        v11_3 = 4294967295u;
                        if _e239 {
                            if _e239 {
                            } else {
                                break;
                            }
                            let _e241 = lightbvh_trails.list[_e238];
                            v11_3 = _e241;
                        }
                        let _e243 = v11_3;
                        v12_3 = _e243;
                    }
                    let _e245 = v12_3;
                    v13_3 = _e245;
                    v14_3 = select(true, false, _e234);
                }
                let _e248 = v13_3;
                let _e250 = v14_3;
                v15_3 = 0u;
                v16_3 = LightbvhType23_(0u, 0u);
                v17_3 = select(_e248, _e232, _e250);
                loop {
                    let _e253 = v15_3;
                    let _e255 = v16_3;
                    let _e257 = v17_3;
                    v27_3 = _e255;
                    v22_3 = u32();
                    v23_3 = LightbvhType23_();
                    v24_3 = u32();
                    v25_3 = false;
                    if (_e257 < 2147483648u) {
                        let _e259 = (_e253 < 20u);
                        v19_3 = u32();
                        v20_3 = LightbvhType23_();
                        v21_3 = u32();
                        if _e259 {
                            let _e278 = (_e157 + (_e257 >> bitcast<u32>(3u)));
                            let _e279 = (_e278 < _e148);
                            v18_3 = 4294967295u;
                            if _e279 {
                                if _e279 {
                                } else {
                                    v26_3 = true;
                                    break;
                                }
                                let _e281 = lightbvh_trails.list[_e278];
                                v18_3 = _e281;
                            }
                            let _e283 = v18_3;
                            v19_3 = (_e253 + 1u);
                            v20_3 = LightbvhType23_((((_e255.member << bitcast<u32>(3u)) | ((_e257 & 7u) & 7u)) & 1073741823u), (((_e255.member_1 << bitcast<u32>(3u)) | ((_e255.member >> bitcast<u32>(27u)) & 7u)) & 1073741823u));
                            v21_3 = _e283;
                        }
                        let _e286 = v19_3;
                        let _e288 = v20_3;
                        let _e290 = v21_3;
                        v22_3 = _e286;
                        v23_3 = _e288;
                        v24_3 = _e290;
                        v25_3 = _e259;
                    }
                    let _e292 = v22_3;
                    let _e294 = v23_3;
                    let _e296 = v24_3;
                    let _e298 = v25_3;
                    continue;
                    continuing {
                        v15_3 = _e292;
                        v16_3 = _e294;
                        v17_3 = _e296;
                        v26_3 = false;
                        break if !(_e298);
                    }
                }
                let _e301 = v26_3;
                if _e301 {
                    break;
                }
                let _e304 = v27_3;
                v8_3 = _e301;
                v9_3 = LightbvhType24_(_e304, LightbvhType23_(_e207, _e220));
            }
            let _e222 = v8_3;
            let _e224 = v9_3;
            v28_3 = _e222;
            v29_3 = _e224;
            if _e185 {
            } else {
                v28_3 = false;
                v29_3 = LightbvhType24_(LightbvhType23_(_e207, _e220), LightbvhType23_(0u, 0u));
            }
            let _e307 = v28_3;
            let _e309 = v29_3;
            let _e311 = (_e175 == 0u);
            let _e312 = LightbvhType31_(_e309, LightbvhType23_(0u, 0u), LightbvhType25_(0f, 1f), 0u, (_e154 + _e151), 4294967295u, 4294967295u, 0u, 4194304u, 0u, _e177.member, _e175, _e311, true);
            let _e315 = (bitcast<u32>(21i) - firstLeadingBit(4128767u));
            let _e317 = select(22u, _e315, (_e315 < 22u));
            let _e318 = (_e317 & 31u);
            let _e336 = LightbvhType31_(_e312.member, LightbvhType23_((4227858432u << bitcast<u32>(_e318)), 0u), _e312.member_2, _e312.member_3, _e312.member_4, _e312.member_5, _e312.member_6, _e312.member_7, _e312.member_8, _e312.member_9, _e312.member_10, _e312.member_11, _e312.member_12, _e312.member_13);
            let _e353 = LightbvhType31_(_e336.member, _e336.member_1, _e336.member_2, _e336.member_3, _e336.member_4, _e336.member_5, _e336.member_6, _e336.member_7, (4128768u << bitcast<u32>(_e318)), _e336.member_9, _e336.member_10, _e336.member_11, _e336.member_12, _e336.member_13);
            v30_3 = _e307;
            v31_3 = LightbvhType31_(_e353.member, _e353.member_1, _e353.member_2, _e353.member_3, _e353.member_4, _e353.member_5, _e353.member_6, _e353.member_7, _e353.member_8, _e317, _e353.member_10, _e353.member_11, _e353.member_12, _e353.member_13);
            v32_3 = _e311;
            loop {
                let _e370 = v30_3;
                let _e372 = v31_3;
                let _e374 = v32_3;
                v59_3 = _e372;
                v60_3 = _e372;
                v61_3 = _e372;
                v62_3 = _e372;
                v55_3 = _e370;
                v56_3 = LightbvhType31_();
                v57_3 = bool();
                if _e374 {
                } else {
                    let _e376 = (_e372.member_4 < _e142);
                    let _e377 = select(0u, _e372.member_4, _e376);
                    if (_e377 < _e142) {
                    } else {
                        v58_3 = true;
                        break;
                    }
                    let _e409 = lightbvh_nodes.list[_e377][0u][3u];
                    let _e412 = (bitcast<i32>((_e409 & 255u)) - 127i);
                    let _e422 = bitcast<f32>((bitcast<u32>(_e372.member_10.member_1[0]) & 2147483647u));
                    let _e425 = bitcast<f32>((bitcast<u32>(_e372.member_10.member_1[1]) & 2147483647u));
                    let _e428 = bitcast<f32>((bitcast<u32>(_e372.member_10.member_1[2]) & 2147483647u));
                    let _e430 = select(_e425, _e422, (_e422 > _e425));
                    let _e438 = (bitcast<i32>(((bitcast<u32>(select(_e428, _e430, (_e430 > _e428))) >> bitcast<u32>(23i)) & 255u)) - 127i);
                    let _e440 = select(_e412, _e438, (_e438 > _e412));
                    let _e446 = (1f - (((_e372.member_10.member_2[0] * _e372.member_10.member_2[0]) + (_e372.member_10.member_2[1] * _e372.member_10.member_2[1])) + (_e372.member_10.member_2[2] * _e372.member_10.member_2[2])));
                    let _e448 = select(0.0000038146973f, _e446, (_e446 > 0.0000038146973f));
                    let _e453 = bitcast<f32>((1595932665u - (bitcast<u32>(_e448) >> bitcast<u32>(1i))));
                    let _e460 = (0.5f * (_e448 * (_e453 * (0.70395225f * (2.3892446f - (_e448 * (_e453 * _e453)))))));
                    let _e462 = (0.0001f + _e460);
                    let _e466 = lightbvh_nodes.list[_e377][0u][0u];
                    let _e471 = lightbvh_nodes.list[_e377][0u][1u];
                    let _e476 = lightbvh_nodes.list[_e377][0u][2u];
                    let _e478 = (bitcast<f32>(_e466) - _e372.member_10.member[0]);
                    let _e479 = (bitcast<f32>(_e471) - _e372.member_10.member[1]);
                    let _e480 = (bitcast<f32>(_e476) - _e372.member_10.member[2]);
                    let _e483 = bitcast<f32>((bitcast<u32>(_e478) & 2147483647u));
                    let _e486 = bitcast<f32>((bitcast<u32>(_e479) & 2147483647u));
                    let _e489 = bitcast<f32>((bitcast<u32>(_e480) & 2147483647u));
                    let _e491 = select(_e486, _e483, (_e483 > _e486));
                    let _e499 = (bitcast<i32>(((bitcast<u32>(select(_e489, _e491, (_e491 > _e489))) >> bitcast<u32>(23i)) & 255u)) - 127i);
                    let _e501 = select(_e440, _e499, (_e499 > _e440));
                    let _e502 = (_e412 - _e501);
                    let _e504 = select(_e502, -40i, (_e502 < -40i));
                    let _e505 = -(_e501);
                    let _e507 = select(_e505, -126i, (_e505 < -126i));
                    let _e514 = bitcast<f32>((bitcast<u32>((select(_e507, 127i, (_e507 > 127i)) + 127i)) << bitcast<u32>(23i)));
                    let _e519 = select(_e504, -126i, (_e504 < -126i));
                    let _e526 = bitcast<f32>((bitcast<u32>((select(_e519, 127i, (_e519 > 127i)) + 127i)) << bitcast<u32>(23i)));
                    let _e527 = (_e372.member_10.member_1[0] * _e514);
                    let _e528 = (_e372.member_10.member_1[1] * _e514);
                    let _e529 = (_e372.member_10.member_1[2] * _e514);
                    let _e532 = bitcast<f32>((bitcast<u32>(_e372.member_10.member_2[0]) & 2147483647u));
                    let _e535 = bitcast<f32>((bitcast<u32>(_e372.member_10.member_2[1]) & 2147483647u));
                    let _e538 = bitcast<f32>((bitcast<u32>(_e372.member_10.member_2[2]) & 2147483647u));
                    let _e543 = (((_e527 * _e532) + (_e528 * _e535)) + (_e529 * _e538));
                    let _e550 = ((0.22222222f * (((_e527 * _e527) + (_e528 * _e528)) + (_e529 * _e529))) + 0.0000000000000008881784f);
                    let _e552 = (_e526 * 0.0000000004656613f);
                    let _e555 = (2f * 8f);
                    let _e556 = (_e532 * _e555);
                    let _e557 = (_e535 * _e555);
                    let _e558 = (_e538 * _e555);
                    v0_3 = array<f32, 8>(0f, 0f, 0f, 0f, 0f, 0f, 0f, 0f);
                    v33_3 = LightbvhType23_(0u, 8u);
                    loop {
                        let _e565 = v33_3;
                        let _e568 = (_e565.member < _e565.member_1);
                        v34_3 = LightbvhType23_();
                        v35_3 = LightbvhType23_();
                        if _e568 {
                            v34_3 = LightbvhType23_((_e565.member + 1u), _e565.member_1);
                            v35_3 = LightbvhType23_(1u, _e565.member);
                        }
                        let _e570 = v34_3;
                        let _e572 = v35_3;
                        v36_3 = _e570;
                        v37_3 = _e572;
                        if _e568 {
                        } else {
                            v36_3 = _e565;
                            v37_3 = LightbvhType23_(0u, LightbvhType23_().member_1);
                        }
                        let _e582 = v36_3;
                        let _e584 = v37_3;
                        let _e588 = (bitcast<i32>(_e584.member) != 0i);
                        if _e588 {
                            let _e589 = (_e584.member_1 < 8u);
                            if _e589 {
                            } else {
                                v38_3 = true;
                                break;
                            }
                            let _e593 = lightbvh_nodes.list[_e377][1u][_e584.member_1];
                            if _e589 {
                            } else {
                                v38_3 = true;
                                break;
                            }
                            let _e597 = lightbvh_nodes.list[_e377][2u][_e584.member_1];
                            if _e589 {
                            } else {
                                v38_3 = true;
                                break;
                            }
                            let _e601 = lightbvh_nodes.list[_e377][3u][_e584.member_1];
                            if _e589 {
                            } else {
                                v38_3 = true;
                                break;
                            }
                            let _e605 = lightbvh_nodes.list[_e377][4u][_e584.member_1];
                            let _e621 = ((_e478 * _e514) + (f32(bitcast<i32>(_e593)) * _e552));
                            let _e622 = ((_e479 * _e514) + (f32(bitcast<i32>((_e593 << bitcast<u32>(15u)))) * _e552));
                            let _e623 = ((_e480 * _e514) + (f32(bitcast<i32>(_e597)) * _e552));
                            let _e628 = bitcast<f32>((((_e605 << bitcast<u32>(20u)) & 267386880u) + (bitcast<u32>(_e526) + 4043309056u)));
                            let _e635 = f32(bitcast<i32>(_e601));
                            let _e639 = f32(bitcast<i32>((_e601 << bitcast<u32>(8u))));
                            let _e643 = f32(bitcast<i32>((_e601 << bitcast<u32>(16u))));
                            let _e647 = (f32(bitcast<i32>((_e601 & 255u))) * 0.003921569f);
                            let _e664 = (_e628 * _e628);
                            let _e665 = (1f + (f32(bitcast<i32>((_e597 << bitcast<u32>(15u)))) * 0.0000000004656613f));
                            let _e666 = (_e664 + _e550);
                            let _e669 = ((_e664 * (_e665 * _e665)) + _e550);
                            let _e674 = bitcast<f32>((1595932665u - (bitcast<u32>(_e666) >> bitcast<u32>(1i))));
                            let _e679 = (_e674 * (0.70395225f * (2.3892446f - (_e666 * (_e674 * _e674)))));
                            let _e680 = (_e666 * _e679);
                            let _e685 = bitcast<f32>((1595932665u - (bitcast<u32>(_e669) >> bitcast<u32>(1i))));
                            let _e693 = (((_e669 * (_e685 * (0.70395225f * (2.3892446f - (_e669 * (_e685 * _e685)))))) * _e679) - 1f);
                            let _e706 = (bitcast<f32>((bitcast<u32>(_e621) & 2147483647u)) - _e527);
                            let _e707 = (bitcast<f32>((bitcast<u32>(_e622) & 2147483647u)) - _e528);
                            let _e708 = (bitcast<f32>((bitcast<u32>(_e623) & 2147483647u)) - _e529);
                            let _e710 = select(0f, _e706, (_e706 > 0f));
                            let _e712 = select(0f, _e707, (_e707 > 0f));
                            let _e714 = select(0f, _e708, (_e708 > 0f));
                            let _e715 = (_e680 * _e680);
                            let _e721 = ((((_e621 * _e621) + (_e622 * _e622)) + (_e623 * _e623)) + 0.0000000000000008881784f);
                            let _e731 = (_e721 + (1.25f * _e715));
                            let _e736 = bitcast<f32>((1595932665u - (bitcast<u32>(_e731) >> bitcast<u32>(1i))));
                            let _e741 = (_e736 * (0.70395225f * (2.3892446f - (_e731 * (_e736 * _e736)))));
                            let _e742 = (_e680 * _e741);
                            let _e747 = ((((_e372.member_10.member_2[0] * 0.0000000004656613f) * _e635) + ((_e372.member_10.member_2[1] * 0.0000000004656613f) * _e639)) + ((_e372.member_10.member_2[2] * 0.0000000004656613f) * _e643));
                            let _e752 = ((0.03162278f + _e460) + (_e742 * (1f + (_e693 * (_e747 * _e747)))));
                            let _e758 = (((((_e372.member_10.member_2[0] + _e372.member_10.member_2[0]) * _e621) + ((_e372.member_10.member_2[1] + _e372.member_10.member_2[1]) * _e622)) + ((_e372.member_10.member_2[2] + _e372.member_10.member_2[2]) * _e623)) * _e741);
                            let _e760 = (_e758 + (((((((_e556 + _e557) + _e558) + ((((_e556 * 0.0000000004656613f) * f32(bitcast<i32>(_e605))) + ((_e557 * 0.0000000004656613f) * f32(bitcast<i32>((_e605 << bitcast<u32>(8u)))))) + ((_e558 * 0.0000000004656613f) * f32(bitcast<i32>((_e605 << bitcast<u32>(16u))))))) * _e628) + (_e543 + _e543)) * _e679) * _e742));
                            let _e762 = select(_e462, _e760, (_e760 > _e462));
                            let _e768 = (bitcast<f32>((bitcast<u32>(_e758) & 2147483647u)) + _e752);
                            let _e774 = (1f + _e693);
                            let _e780 = ((((_e635 * _e621) + (_e639 * _e622)) + (_e643 * _e623)) * (-2f * 0.0000000004656613f));
                            let _e783 = (_e680 * select(_e647, _e774, (_e774 > _e647)));
                            let _e785 = (_e721 - (2.5f * _e715));
                            let _e787 = (0.25f * (_e780 * _e780));
                            let _e793 = ((select(_e787, _e785, (_e785 > _e787)) + 0.0000000000000008881784f) + (1.25f * (_e783 * _e783)));
                            let _e798 = bitcast<f32>((1595932665u - (bitcast<u32>(_e793) >> bitcast<u32>(1i))));
                            let _e803 = (_e798 * (0.70395225f * (2.3892446f - (_e793 * (_e798 * _e798)))));
                            let _e805 = ((_e680 * _e803) * _e774);
                            let _e809 = ((0.03162278f + _e805) + (_e647 * (0.5f - _e805)));
                            let _e810 = (_e780 * _e803);
                            let _e814 = (bitcast<f32>((bitcast<u32>(_e810) & 2147483647u)) + _e809);
                            let _e823 = ((_e768 * _e814) * (((((_e710 * _e710) + (_e712 * _e712)) + (_e714 * _e714)) + 0.0000000000000008881784f) + (0.5f * _e715)));
                            let _e826 = bitcast<f32>((2129859015u - bitcast<u32>(_e823)));
                            if _e589 {
                            } else {
                                v38_3 = true;
                                break;
                            }
                            v0_3[_e584.member_1] = ((bitcast<f32>(((_e597 & 2047u) << bitcast<u32>(19u))) * (((select(0f, _e758, (_e758 > 0f)) * _e768) + (_e752 * select(_e752, _e762, (_e762 < _e752)))) * ((select(0f, _e810, (_e810 > 0f)) * _e814) + (_e809 * _e809)))) * (_e826 * (2f - (_e823 * _e826))));
                        }
                        continue;
                        continuing {
                            v33_3 = _e582;
                            v38_3 = _e370;
                            break if !(_e588);
                        }
                    }
                    let _e834 = v38_3;
                    v58_3 = _e834;
                    if _e834 {
                        break;
                    }
                    let _e835 = v0_3;
                    let _e852 = (_e372.member_7 < 20u);
                    v39_3 = u32();
                    if _e852 {
                        let _e875 = (_e372.member_7 < 10u);
                        v41_3 = _e372.member_7;
                        if _e875 {
                        } else {
                            v41_3 = (_e372.member_7 - 10u);
                        }
                        let _e878 = v41_3;
                        v39_3 = ((select(_e372.member.member.member_1, _e372.member.member.member, _e875) >> bitcast<u32>((((_e878 * 3u) & 31u) & 31u))) & 7u);
                    }
                    let _e854 = v39_3;
                    v42_3 = _e854;
                    if _e852 {
                    } else {
                        let _e859 = (_e372.member_7 - 20u);
                        let _e860 = (_e859 < 10u);
                        v40_3 = _e859;
                        if _e860 {
                        } else {
                            v40_3 = (_e372.member_7 - 30u);
                        }
                        let _e863 = v40_3;
                        v42_3 = ((select(_e372.member.member_1.member_1, _e372.member.member_1.member, _e860) >> bitcast<u32>((((_e863 * 3u) & 31u) & 31u))) & 7u);
                    }
                    let _e887 = v42_3;
                    let _e892 = (0u - select(0u, 1u, (_e835[1] > 0f)));
                    let _e893 = (1u & _e892);
                    let _e897 = (0u - select(0u, 1u, (_e835[2] > 0f)));
                    let _e900 = (_e893 ^ ((2u ^ _e893) & _e897));
                    let _e904 = (0u - select(0u, 1u, (_e835[3] > 0f)));
                    let _e907 = (_e900 ^ ((3u ^ _e900) & _e904));
                    let _e911 = (0u - select(0u, 1u, (_e835[4] > 0f)));
                    let _e914 = (_e907 ^ ((4u ^ _e907) & _e911));
                    let _e918 = (0u - select(0u, 1u, (_e835[5] > 0f)));
                    let _e921 = (_e914 ^ ((5u ^ _e914) & _e918));
                    let _e925 = (0u - select(0u, 1u, (_e835[6] > 0f)));
                    let _e928 = (_e921 ^ ((6u ^ _e921) & _e925));
                    let _e932 = (0u - select(0u, 1u, (_e835[7] > 0f)));
                    let _e935 = (_e928 ^ ((7u ^ _e928) & _e932));
                    let _e938 = ((((0f + _e835[0]) + _e835[4]) + ((0f + _e835[2]) + _e835[6])) + (((0f + _e835[1]) + _e835[5]) + ((0f + _e835[3]) + _e835[7])));
                    let _e939 = (_e938 > 0f);
                    let _e943 = select(1f, _e938, _e939);
                    let _e944 = bitcast<u32>(_e943);
                    let _e949 = bitcast<f32>(((_e944 & 2147483648u) | (2129859015u - (_e944 & 2147483647u))));
                    let _e952 = (_e949 * (2f - (_e943 * _e949)));
                    let _e956 = ((f32(bitcast<i32>(_e372.member_8)) * 0.9999695f) * (_e952 * (2f - (_e943 * _e952))));
                    v43_3 = 2147483647i;
                    if _e372.member_13 {
                    } else {
                        v43_3 = bitcast<i32>((_e372.member_1.member >> bitcast<u32>(10u)));
                    }
                    let _e959 = v43_3;
                    let _e965 = bitcast<i32>((bitcast<u32>(((_e835[0] * _e956) + 8388608f)) & 8388607u));
                    let _e972 = (select(1i, _e965, (_e965 > 1i)) & bitcast<i32>((0u - select(0u, 1u, (_e835[0] > 0f)))));
                    let _e973 = bitcast<u32>(_e972);
                    let _e974 = (_e973 & 4294967295u);
                    let _e976 = bitcast<i32>(select(_e935, _e887, _e372.member_13));
                    let _e980 = (0u - select(0u, 1u, ((_e972 <= _e959) && (0i < _e976))));
                    let _e981 = (_e973 & _e980);
                    let _e987 = bitcast<i32>((bitcast<u32>(((_e835[1] * _e956) + 8388608f)) & 8388607u));
                    let _e992 = (_e972 + (select(1i, _e987, (_e987 > 1i)) & bitcast<i32>(_e892)));
                    let _e993 = bitcast<u32>(_e992);
                    let _e996 = (_e974 ^ ((_e993 ^ _e974) & _e980));
                    let _e1001 = (0u - select(0u, 1u, ((_e992 <= _e959) && (1i < _e976))));
                    let _e1004 = (_e981 ^ ((_e993 ^ _e981) & _e1001));
                    let _e1011 = bitcast<i32>((bitcast<u32>(((_e835[2] * _e956) + 8388608f)) & 8388607u));
                    let _e1016 = (_e992 + (select(1i, _e1011, (_e1011 > 1i)) & bitcast<i32>(_e897)));
                    let _e1017 = bitcast<u32>(_e1016);
                    let _e1020 = (_e996 ^ ((_e1017 ^ _e996) & _e1001));
                    let _e1025 = (0u - select(0u, 1u, ((_e1016 <= _e959) && (2i < _e976))));
                    let _e1028 = (_e1004 ^ ((_e1017 ^ _e1004) & _e1025));
                    let _e1035 = bitcast<i32>((bitcast<u32>(((_e835[3] * _e956) + 8388608f)) & 8388607u));
                    let _e1040 = (_e1016 + (select(1i, _e1035, (_e1035 > 1i)) & bitcast<i32>(_e904)));
                    let _e1041 = bitcast<u32>(_e1040);
                    let _e1044 = (_e1020 ^ ((_e1041 ^ _e1020) & _e1025));
                    let _e1049 = (0u - select(0u, 1u, ((_e1040 <= _e959) && (3i < _e976))));
                    let _e1052 = (_e1028 ^ ((_e1041 ^ _e1028) & _e1049));
                    let _e1059 = bitcast<i32>((bitcast<u32>(((_e835[4] * _e956) + 8388608f)) & 8388607u));
                    let _e1064 = (_e1040 + (select(1i, _e1059, (_e1059 > 1i)) & bitcast<i32>(_e911)));
                    let _e1065 = bitcast<u32>(_e1064);
                    let _e1068 = (_e1044 ^ ((_e1065 ^ _e1044) & _e1049));
                    let _e1073 = (0u - select(0u, 1u, ((_e1064 <= _e959) && (4i < _e976))));
                    let _e1076 = (_e1052 ^ ((_e1065 ^ _e1052) & _e1073));
                    let _e1083 = bitcast<i32>((bitcast<u32>(((_e835[5] * _e956) + 8388608f)) & 8388607u));
                    let _e1088 = (_e1064 + (select(1i, _e1083, (_e1083 > 1i)) & bitcast<i32>(_e918)));
                    let _e1089 = bitcast<u32>(_e1088);
                    let _e1092 = (_e1068 ^ ((_e1089 ^ _e1068) & _e1073));
                    let _e1097 = (0u - select(0u, 1u, ((_e1088 <= _e959) && (5i < _e976))));
                    let _e1100 = (_e1076 ^ ((_e1089 ^ _e1076) & _e1097));
                    let _e1107 = bitcast<i32>((bitcast<u32>(((_e835[6] * _e956) + 8388608f)) & 8388607u));
                    let _e1112 = (_e1088 + (select(1i, _e1107, (_e1107 > 1i)) & bitcast<i32>(_e925)));
                    let _e1113 = bitcast<u32>(_e1112);
                    let _e1116 = (_e1092 ^ ((_e1113 ^ _e1092) & _e1097));
                    let _e1121 = (0u - select(0u, 1u, ((_e1112 <= _e959) && (6i < _e976))));
                    let _e1124 = (_e1100 ^ ((_e1113 ^ _e1100) & _e1121));
                    let _e1131 = bitcast<i32>((bitcast<u32>(((_e835[7] * _e956) + 8388608f)) & 8388607u));
                    let _e1136 = (_e1112 + (select(1i, _e1131, (_e1131 > 1i)) & bitcast<i32>(_e932)));
                    let _e1137 = bitcast<u32>(_e1136);
                    let _e1140 = (_e1116 ^ ((_e1137 ^ _e1116) & _e1121));
                    let _e1145 = (0u - select(0u, 1u, ((_e1136 <= _e959) && (7i < _e976))));
                    let _e1148 = (_e1124 ^ ((_e1137 ^ _e1124) & _e1145));
                    let _e1151 = select(((((((((_e980 & 1u) + (_e1001 & 1u)) + (_e1025 & 1u)) + (_e1049 & 1u)) + (_e1073 & 1u)) + (_e1097 & 1u)) + (_e1121 & 1u)) + (_e1145 & 1u)), _e887, _e372.member_13);
                    let _e1156 = (_e1151 < 8u);
                    let _e1157 = ((_e939 && (_e1140 > _e1148)) && _e1156);
                    let _e1158 = select(0u, _e1151, _e1156);
                    v44_3 = 0u;
                    if _e1157 {
                        v44_3 = (select(_e1140, _e372.member_8, (_e1151 == _e935)) - _e1148);
                    }
                    let _e1162 = v44_3;
                    let _e1163 = (_e1158 < 8u);
                    if _e1163 {
                    } else {
                        v58_3 = true;
                        break;
                    }
                    let _e1167 = lightbvh_nodes.list[_e377][1u][_e1158];
                    let _e1168 = (_e1167 & 3u);
                    if _e1163 {
                    } else {
                        v58_3 = true;
                        break;
                    }
                    let _e1172 = lightbvh_nodes.list[_e377][5u][_e1158];
                    let _e1176 = ((_e376 && (_e1162 > 0u)) && (_e1162 <= _e372.member_8));
                    let _e1177 = select(1u, _e1162, _e1176);
                    let _e1179 = ((_e1177 - 1u) & 4194303u);
                    let _e1185 = (select((bitcast<u32>(31i) - firstLeadingBit(_e1179)), 32u, (_e1179 == 0u)) - 10u);
                    let _e1187 = select(22u, _e1185, (_e1185 < 22u));
                    let _e1199 = (_e1187 & 31u);
                    let _e1220 = LightbvhType31_(_e372.member, LightbvhType23_((((_e372.member_1.member - (select(0u, _e1148, _e1157) << bitcast<u32>(10u))) << bitcast<u32>(_e1199)) | ((_e372.member_1.member_1 >> bitcast<u32>(1i)) >> bitcast<u32>(((31u - _e1187) & 31u)))), (_e372.member_1.member_1 << bitcast<u32>(_e1199))), _e372.member_2, _e372.member_3, _e372.member_4, _e372.member_5, _e372.member_6, _e372.member_7, _e372.member_8, _e372.member_9, _e372.member_10, _e372.member_11, _e372.member_12, _e372.member_13);
                    let _e1237 = LightbvhType31_(_e1220.member, _e1220.member_1, _e1220.member_2, _e1220.member_3, _e1220.member_4, _e1220.member_5, _e1220.member_6, _e1220.member_7, (_e1177 << bitcast<u32>(_e1199)), _e1220.member_9, _e1220.member_10, _e1220.member_11, _e1220.member_12, _e1220.member_13);
                    let _e1254 = LightbvhType31_(_e1237.member, _e1237.member_1, _e1237.member_2, _e1237.member_3, _e1237.member_4, _e1237.member_5, _e1237.member_6, _e1237.member_7, _e1237.member_8, (_e372.member_9 + _e1187), _e1237.member_10, _e1237.member_11, _e1237.member_12, _e1237.member_13);
                    let _e1255 = (_e372.member_7 + 1u);
                    v45_3 = true;
                    if (_e1255 == 20u) {
                    } else {
                        v45_3 = (_e1255 == 40u);
                    }
                    let _e1259 = v45_3;
                    let _e1260 = (_e1172 & 134217727u);
                    let _e1264 = (_e1172 >> bitcast<u32>((firstTrailingBit(134217728u) & 31u)));
                    let _e1268 = (_e1260 < _e145);
                    let _e1269 = (((_e1176 && (_e1168 == 3u)) && _e852) && _e1268);
                    let _e1273 = ((_e1176 && (_e1168 == 1u)) && !(_e1259));
                    let _e1291 = LightbvhType31_(_e1254.member, _e1254.member_1, _e1254.member_2, _e1254.member_3, _e1254.member_4, select(4294967295u, _e1172, (_e1176 && (_e1168 == 2u))), _e1254.member_6, _e1254.member_7, _e1254.member_8, _e1254.member_9, _e1254.member_10, _e1254.member_11, _e1254.member_12, _e1254.member_13);
                    let _e1293 = (_e372.member_11 - 1u);
                    let _e1308 = LightbvhType31_(_e1291.member, _e1291.member_1, _e1291.member_2, _e1291.member_3, _e1291.member_4, _e1291.member_5, _e1291.member_6, _e1291.member_7, _e1291.member_8, _e1291.member_9, _e1291.member_10, _e1293, _e1291.member_12, _e1291.member_13);
                    let _e1312 = (!((_e1269 || _e1273)) || (_e1293 == 0u));
                    let _e1327 = LightbvhType31_(_e1308.member, _e1308.member_1, _e1308.member_2, _e1308.member_3, _e1308.member_4, _e1308.member_5, _e1308.member_6, _e1308.member_7, _e1308.member_8, _e1308.member_9, _e1308.member_10, _e1308.member_11, _e1312, _e1308.member_13);
                    v46_3 = LightbvhType31_();
                    if _e1269 {
                        if _e1268 {
                        } else {
                            v58_3 = true;
                            break;
                        }
                        let _e1380 = LightbvhType31_(_e1327.member, _e1327.member_1, _e1327.member_2, _e1327.member_3, _e1327.member_4, _e1327.member_5, _e1260, _e1327.member_7, _e1327.member_8, _e1327.member_9, _e1327.member_10, _e1327.member_11, _e1327.member_12, _e1327.member_13);
                        let _e1383 = lightbvh_instances.list[_e1260].root;
                        let _e1398 = LightbvhType31_(_e1380.member, _e1380.member_1, _e1380.member_2, _e1380.member_3, _e1383, _e1380.member_5, _e1380.member_6, _e1380.member_7, _e1380.member_8, _e1380.member_9, _e1380.member_10, _e1380.member_11, _e1380.member_12, _e1380.member_13);
                        let _e1399 = (_e1383 == 4294967295u);
                        v48_3 = 4294967295u;
                        if _e1399 {
                            let _e1402 = lightbvh_instances.list[_e1260].first_light;
                            v48_3 = _e1402;
                        }
                        let _e1404 = v48_3;
                        let _e1419 = LightbvhType31_(_e1398.member, _e1398.member_1, _e1398.member_2, _e1398.member_3, _e1398.member_4, _e1404, _e1398.member_6, _e1398.member_7, _e1398.member_8, _e1398.member_9, _e1398.member_10, _e1398.member_11, _e1398.member_12, _e1398.member_13);
                        let _e1420 = (_e1312 || _e1399);
                        let _e1435 = LightbvhType31_(_e1419.member, _e1419.member_1, _e1419.member_2, _e1419.member_3, _e1419.member_4, _e1419.member_5, _e1419.member_6, _e1419.member_7, _e1419.member_8, _e1419.member_9, _e1419.member_10, _e1419.member_11, _e1420, _e1419.member_13);
                        let _e1450 = LightbvhType31_(_e1435.member, _e1435.member_1, _e1435.member_2, _e1435.member_3, _e1435.member_4, _e1435.member_5, _e1435.member_6, 20u, _e1435.member_8, _e1435.member_9, _e1435.member_10, _e1435.member_11, _e1435.member_12, _e1435.member_13);
                        v49_3 = _e1450;
                        if (_e1264 > 0u) {
                            let _e1453 = select(0u, _e1383, (_e1383 < _e142));
                            if (_e1453 < _e142) {
                            } else {
                                v58_3 = true;
                                break;
                            }
                            let _e1456 = ((_e1264 - 1u) % 8u);
                            let _e1457 = (_e1456 < 8u);
                            if _e1457 {
                            } else {
                                v58_3 = true;
                                break;
                            }
                            let _e1461 = lightbvh_nodes.list[_e1453][1u][_e1456];
                            let _e1462 = (_e1461 & 3u);
                            if _e1457 {
                            } else {
                                v58_3 = true;
                                break;
                            }
                            let _e1466 = lightbvh_nodes.list[_e1453][5u][_e1456];
                            let _e1481 = LightbvhType31_(_e1450.member, _e1450.member_1, _e1450.member_2, _e1450.member_3, _e1466, _e1450.member_5, _e1450.member_6, _e1450.member_7, _e1450.member_8, _e1450.member_9, _e1450.member_10, _e1450.member_11, _e1450.member_12, _e1450.member_13);
                            let _e1498 = LightbvhType31_(_e1481.member, _e1481.member_1, _e1481.member_2, _e1481.member_3, _e1481.member_4, select(4294967295u, _e1466, (_e1462 == 2u)), _e1481.member_6, _e1481.member_7, _e1481.member_8, _e1481.member_9, _e1481.member_10, _e1481.member_11, _e1481.member_12, _e1481.member_13);
                            let _e1515 = LightbvhType31_(_e1498.member, _e1498.member_1, _e1498.member_2, _e1498.member_3, _e1498.member_4, _e1498.member_5, _e1498.member_6, _e1498.member_7, _e1498.member_8, _e1498.member_9, _e1498.member_10, _e1498.member_11, (_e1420 || (_e1462 != 1u)), _e1498.member_13);
                            v49_3 = LightbvhType31_(_e1515.member, _e1515.member_1, _e1515.member_2, _e1515.member_3, _e1515.member_4, _e1515.member_5, _e1515.member_6, 21u, _e1515.member_8, _e1515.member_9, _e1515.member_10, _e1515.member_11, _e1515.member_12, _e1515.member_13);
                        }
                        let _e1532 = v49_3;
                        let _e1541 = lightbvh_instances.list[_e1260].translation[0u];
                        let _e1545 = lightbvh_instances.list[_e1260].translation[1u];
                        let _e1549 = lightbvh_instances.list[_e1260].translation[2u];
                        let _e1550 = (_e177.member.member[0] - _e1541);
                        let _e1551 = (_e177.member.member[1] - _e1545);
                        let _e1552 = (_e177.member.member[2] - _e1549);
                        let _e1557 = select(_e1550, 0f, (bitcast<f32>((bitcast<u32>(_e1550) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1562 = select(_e1551, 0f, (bitcast<f32>((bitcast<u32>(_e1551) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1567 = select(_e1552, 0f, (bitcast<f32>((bitcast<u32>(_e1552) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1572 = lightbvh_instances.list[_e1260].inverse[0u][0u];
                        let _e1577 = lightbvh_instances.list[_e1260].inverse[0u][1u];
                        let _e1582 = lightbvh_instances.list[_e1260].inverse[0u][2u];
                        let _e1590 = lightbvh_instances.list[_e1260].inverse[1u][0u];
                        let _e1595 = lightbvh_instances.list[_e1260].inverse[1u][1u];
                        let _e1600 = lightbvh_instances.list[_e1260].inverse[1u][2u];
                        let _e1611 = lightbvh_instances.list[_e1260].inverse[2u][0u];
                        let _e1616 = lightbvh_instances.list[_e1260].inverse[2u][1u];
                        let _e1621 = lightbvh_instances.list[_e1260].inverse[2u][2u];
                        let _e1625 = (((_e1572 * _e1557) + (_e1590 * _e1562)) + (_e1611 * _e1567));
                        let _e1626 = (((_e1577 * _e1557) + (_e1595 * _e1562)) + (_e1616 * _e1567));
                        let _e1627 = (((_e1582 * _e1557) + (_e1600 * _e1562)) + (_e1621 * _e1567));
                        let _e1635 = lightbvh_instances.list[_e1260].columns[0u][0u];
                        let _e1640 = lightbvh_instances.list[_e1260].columns[0u][1u];
                        let _e1645 = lightbvh_instances.list[_e1260].columns[0u][2u];
                        let _e1650 = (((_e1635 * _e177.member.member_2[0]) + (_e1640 * _e177.member.member_2[1])) + (_e1645 * _e177.member.member_2[2]));
                        let _e1655 = lightbvh_instances.list[_e1260].columns[1u][0u];
                        let _e1660 = lightbvh_instances.list[_e1260].columns[1u][1u];
                        let _e1665 = lightbvh_instances.list[_e1260].columns[1u][2u];
                        let _e1670 = (((_e1655 * _e177.member.member_2[0]) + (_e1660 * _e177.member.member_2[1])) + (_e1665 * _e177.member.member_2[2]));
                        let _e1675 = lightbvh_instances.list[_e1260].columns[2u][0u];
                        let _e1680 = lightbvh_instances.list[_e1260].columns[2u][1u];
                        let _e1685 = lightbvh_instances.list[_e1260].columns[2u][2u];
                        let _e1690 = (((_e1675 * _e177.member.member_2[0]) + (_e1680 * _e177.member.member_2[1])) + (_e1685 * _e177.member.member_2[2]));
                        let _e1695 = select(_e1650, 0f, (bitcast<f32>((bitcast<u32>(_e1650) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1700 = select(_e1670, 0f, (bitcast<f32>((bitcast<u32>(_e1670) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1705 = select(_e1690, 0f, (bitcast<f32>((bitcast<u32>(_e1690) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1710 = (((_e1695 * _e1695) + (_e1700 * _e1700)) + (_e1705 * _e1705));
                        let _e1711 = bitcast<f32>(67108864u);
                        v50_3 = 0f;
                        if (_e1710 >= _e1711) {
                            let _e1717 = bitcast<f32>((1597463007u - (bitcast<u32>(_e1710) >> bitcast<u32>(1i))));
                            let _e1718 = (0.5f * _e1710);
                            let _e1722 = (_e1717 * (1.5f - ((_e1718 * _e1717) * _e1717)));
                            v50_3 = (_e1722 * (1.5f - ((_e1718 * _e1722) * _e1722)));
                        }
                        let _e1728 = v50_3;
                        let _e1729 = -(1152921500000000000f);
                        v51_3 = _e1729;
                        if (_e1625 < _e1729) {
                        } else {
                            v51_3 = select(_e1625, 1152921500000000000f, (_e1625 > 1152921500000000000f));
                        }
                        let _e1734 = v51_3;
                        v52_3 = _e1729;
                        if (_e1626 < _e1729) {
                        } else {
                            v52_3 = select(_e1626, 1152921500000000000f, (_e1626 > 1152921500000000000f));
                        }
                        let _e1744 = v52_3;
                        v53_3 = _e1729;
                        if (_e1627 < _e1729) {
                        } else {
                            v53_3 = select(_e1627, 1152921500000000000f, (_e1627 > 1152921500000000000f));
                        }
                        let _e1754 = v53_3;
                        let _e1761 = (_e1695 * _e1728);
                        let _e1767 = (_e1700 * _e1728);
                        let _e1773 = (_e1705 * _e1728);
                        let _e1789 = select(_e177.member.member_2[0], 0f, (bitcast<f32>((bitcast<u32>(_e177.member.member_2[0]) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1794 = select(_e177.member.member_2[1], 0f, (bitcast<f32>((bitcast<u32>(_e177.member.member_2[1]) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1799 = select(_e177.member.member_2[2], 0f, (bitcast<f32>((bitcast<u32>(_e177.member.member_2[2]) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1804 = (((_e1789 * _e1789) + (_e1794 * _e1794)) + (_e1799 * _e1799));
                        let _e1806 = select(_e1711, _e1804, (_e1804 > _e1711));
                        let _e1811 = bitcast<f32>((1597463007u - (bitcast<u32>(_e1806) >> bitcast<u32>(1i))));
                        let _e1812 = (0.5f * _e1806);
                        let _e1816 = (_e1811 * (1.5f - ((_e1812 * _e1811) * _e1811)));
                        let _e1821 = (_e1806 * (_e1816 * (1.5f - ((_e1812 * _e1816) * _e1816))));
                        let _e1822 = (select(_e1761, 0f, (bitcast<f32>((bitcast<u32>(_e1761) & 2147483647u)) < 0.00000000000000000086736174f)) * _e1821);
                        let _e1823 = (select(_e1767, 0f, (bitcast<f32>((bitcast<u32>(_e1767) & 2147483647u)) < 0.00000000000000000086736174f)) * _e1821);
                        let _e1824 = (select(_e1773, 0f, (bitcast<f32>((bitcast<u32>(_e1773) & 2147483647u)) < 0.00000000000000000086736174f)) * _e1821);
                        let _e1850 = select(_e177.member.member_1[0], 0f, (bitcast<f32>((bitcast<u32>(_e177.member.member_1[0]) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1855 = select(_e177.member.member_1[1], 0f, (bitcast<f32>((bitcast<u32>(_e177.member.member_1[1]) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1860 = select(_e177.member.member_1[2], 0f, (bitcast<f32>((bitcast<u32>(_e177.member.member_1[2]) & 2147483647u)) < 0.00000000000000000086736174f));
                        let _e1900 = (((bitcast<f32>((bitcast<u32>(_e1572) & 2147483647u)) * _e1850) + (bitcast<f32>((bitcast<u32>(_e1590) & 2147483647u)) * _e1855)) + (bitcast<f32>((bitcast<u32>(_e1611) & 2147483647u)) * _e1860));
                        let _e1901 = (((bitcast<f32>((bitcast<u32>(_e1577) & 2147483647u)) * _e1850) + (bitcast<f32>((bitcast<u32>(_e1595) & 2147483647u)) * _e1855)) + (bitcast<f32>((bitcast<u32>(_e1616) & 2147483647u)) * _e1860));
                        let _e1902 = (((bitcast<f32>((bitcast<u32>(_e1582) & 2147483647u)) * _e1850) + (bitcast<f32>((bitcast<u32>(_e1600) & 2147483647u)) * _e1855)) + (bitcast<f32>((bitcast<u32>(_e1621) & 2147483647u)) * _e1860));
                        let _e1904 = select(1152921500000000000f, _e1900, (_e1900 < 1152921500000000000f));
                        let _e1906 = select(1152921500000000000f, _e1901, (_e1901 < 1152921500000000000f));
                        let _e1908 = select(1152921500000000000f, _e1902, (_e1902 < 1152921500000000000f));
                        v46_3 = LightbvhType31_(_e1532.member, _e1532.member_1, _e1532.member_2, _e1532.member_3, _e1532.member_4, _e1532.member_5, _e1532.member_6, _e1532.member_7, _e1532.member_8, _e1532.member_9, LightbvhType29_(array<f32, 3>(select(_e1734, 0f, (bitcast<f32>((bitcast<u32>(_e1734) & 2147483647u)) < 0.00000000000000000086736174f)), select(_e1744, 0f, (bitcast<f32>((bitcast<u32>(_e1744) & 2147483647u)) < 0.00000000000000000086736174f)), select(_e1754, 0f, (bitcast<f32>((bitcast<u32>(_e1754) & 2147483647u)) < 0.00000000000000000086736174f))), array<f32, 3>(select(_e1904, 0f, (bitcast<f32>((bitcast<u32>(_e1904) & 2147483647u)) < 0.00000000000000000086736174f)), select(_e1906, 0f, (bitcast<f32>((bitcast<u32>(_e1906) & 2147483647u)) < 0.00000000000000000086736174f)), select(_e1908, 0f, (bitcast<f32>((bitcast<u32>(_e1908) & 2147483647u)) < 0.00000000000000000086736174f))), array<f32, 3>(select(_e1822, 0f, (bitcast<f32>((bitcast<u32>(_e1822) & 2147483647u)) < 0.00000000000000000086736174f)), select(_e1823, 0f, (bitcast<f32>((bitcast<u32>(_e1823) & 2147483647u)) < 0.00000000000000000086736174f)), select(_e1824, 0f, (bitcast<f32>((bitcast<u32>(_e1824) & 2147483647u)) < 0.00000000000000000086736174f)))), _e1532.member_11, _e1532.member_12, _e1532.member_13);
                    }
                    let _e1329 = v46_3;
                    v54_3 = _e1329;
                    if _e1269 {
                    } else {
                        v47_3 = _e372.member_4;
                        if _e1273 {
                            v47_3 = (_e1172 + select(0u, _e151, _e852));
                        }
                        let _e1333 = v47_3;
                        let _e1348 = LightbvhType31_(_e1327.member, _e1327.member_1, _e1327.member_2, _e1327.member_3, _e1333, _e1327.member_5, _e1327.member_6, _e1327.member_7, _e1327.member_8, _e1327.member_9, _e1327.member_10, _e1327.member_11, _e1327.member_12, _e1327.member_13);
                        v54_3 = LightbvhType31_(_e1348.member, _e1348.member_1, _e1348.member_2, _e1348.member_3, _e1348.member_4, _e1348.member_5, _e1348.member_6, (_e372.member_7 + select(0u, 1u, _e1273)), _e1348.member_8, _e1348.member_9, _e1348.member_10, _e1348.member_11, _e1348.member_12, _e1348.member_13);
                    }
                    let _e1943 = v54_3;
                    v55_3 = _e834;
                    v56_3 = _e1943;
                    v57_3 = _e1943.member_12;
                }
                let _e1946 = v55_3;
                let _e1948 = v56_3;
                let _e1950 = v57_3;
                continue;
                continuing {
                    v30_3 = _e1946;
                    v31_3 = _e1948;
                    v32_3 = _e1950;
                    v58_3 = _e1946;
                    break if !(select(true, false, _e374));
                }
            }
            let _e1954 = v58_3;
            if _e1954 {
                break;
            }
            let _e1956 = v59_3;
            let _e1960 = v60_3;
            v63_3 = 0f;
            if (((_e1956.member_5 == _e201) && (_e1960.member_6 == _e184)) && (_e201 != 4294967295u)) {
                let _e1967 = v61_3;
                let _e1972 = v62_3;
                let _e1978 = -(bitcast<i32>((22u + select(98u, _e1967.member_9, (_e1967.member_9 < 98u)))));
                let _e1980 = select(_e1978, -126i, (_e1978 < -126i));
                v63_3 = (f32(bitcast<i32>(_e1972.member_8)) * bitcast<f32>((bitcast<u32>((select(_e1980, 127i, (_e1980 > 127i)) + 127i)) << bitcast<u32>(23i))));
            }
            let _e1990 = v63_3;
            v65_3 = u32();
            v66_3 = true;
            if _e183 {
                v64_3 = u32();
                if _e185 {
                    if _e185 {
                    } else {
                        break;
                    }
                    let _e1993 = lightbvh_instances.list[_e184].count;
                    v64_3 = _e1993;
                }
                let _e1995 = v64_3;
                v65_3 = _e1995;
                v66_3 = select(true, false, _e185);
            }
            let _e1998 = v65_3;
            let _e2000 = v66_3;
            let _e2005 = (select(_e1998, _e172, _e2000) & 2147483647u);
            let _e2010 = bitcast<u32>((f32(65536i) * bitcast<f32>(880803840u)));
            let _e2011 = bitcast<u32>(f32(bitcast<i32>(select(1u, _e2005, (_e2005 > 0u)))));
            let _e2016 = ((_e2010 >> bitcast<u32>(23i)) & 255u);
            let _e2020 = (_e2010 & 8388607u);
            let _e2021 = (_e2020 | 8388608u);
            let _e2022 = (_e2011 & 8388607u);
            let _e2023 = (_e2022 | 8388608u);
            let _e2024 = (_e2021 < _e2023);
            let _e2028 = bitcast<f32>((_e2022 | 1065353216u));
            let _e2029 = bitcast<u32>(_e2028);
            let _e2034 = bitcast<f32>(((_e2029 & 2147483648u) | (2129859015u - (_e2029 & 2147483647u))));
            let _e2037 = (_e2034 * (2f - (_e2028 * _e2034)));
            let _e2040 = (_e2037 * (2f - (_e2028 * _e2037)));
            let _e2044 = ((bitcast<f32>((_e2020 | 1065353216u)) * _e2040) * select(8388608f, 16777216f, _e2024));
            let _e2045 = bitcast<f32>(0u);
            let _e2046 = bitcast<f32>(1333788671u);
            let _e2051 = select(select(u32(_e2044), 0u, (_e2044 < _e2045)), 4294967295u, (_e2044 > _e2046));
            let _e2057 = bitcast<i32>(((_e2021 << bitcast<u32>((select(23i, 24i, _e2024) & 31i))) - (_e2051 * _e2023)));
            let _e2062 = ((f32((_e2057 >> bitcast<u32>(8i))) * _e2040) * 0.000030517578f);
            let _e2063 = bitcast<f32>(3472883712u);
            let _e2064 = bitcast<f32>(1325400063u);
            let _e2071 = select(0i, select(select(i32(_e2062), i32(-2147483648), (_e2062 < _e2063)), 2147483647i, (_e2062 > _e2064)), (_e2062 == _e2062));
            let _e2073 = (_e2051 + bitcast<u32>(_e2071));
            let _e2074 = bitcast<i32>(_e2023);
            let _e2076 = (_e2057 - (_e2071 * _e2074));
            let _e2077 = (_e2076 < 0i);
            v67_3 = _e2073;
            if _e2077 {
                v67_3 = (_e2073 - 1u);
            }
            let _e2080 = v67_3;
            v68_3 = _e2076;
            if _e2077 {
                v68_3 = (_e2076 + _e2074);
            }
            let _e2083 = v68_3;
            let _e2084 = (_e2083 >= _e2074);
            v69_3 = _e2080;
            if _e2084 {
                v69_3 = (_e2080 + 1u);
            }
            let _e2087 = v69_3;
            v70_3 = _e2083;
            if _e2084 {
                v70_3 = (_e2083 - _e2074);
            }
            let _e2090 = v70_3;
            v71_3 = _e2087;
            if ((_e2090 * 2i) > _e2074) {
                v71_3 = (_e2087 + 1u);
            }
            let _e2095 = v71_3;
            let _e2100 = ((bitcast<i32>(_e2016) - bitcast<i32>(((_e2011 >> bitcast<u32>(23i)) & 255u))) + select(127i, 126i, _e2024));
            v74_3 = u32();
            v75_3 = true;
            if (_e2016 == 0u) {
            } else {
                let _e2102 = (_e2100 <= 0i);
                v73_3 = u32();
                if _e2102 {
                } else {
                    v72_3 = 2139095040u;
                    if (_e2100 >= 255i) {
                    } else {
                        v72_3 = ((bitcast<u32>(_e2100) << bitcast<u32>(23i)) + (_e2095 & 8388607u));
                    }
                    let _e2110 = v72_3;
                    v73_3 = _e2110;
                }
                let _e2112 = v73_3;
                v74_3 = _e2112;
                v75_3 = _e2102;
            }
            let _e2114 = v74_3;
            let _e2116 = v75_3;
            let _e2120 = (_e169 & 2147483647u);
            let _e2125 = bitcast<u32>(bitcast<f32>((((_e2010 ^ _e2011) & 2147483648u) | select(_e2114, 0u, _e2116))));
            let _e2126 = bitcast<u32>(f32(bitcast<i32>(select(1u, _e2120, (_e2120 > 0u)))));
            let _e2131 = ((_e2125 >> bitcast<u32>(23i)) & 255u);
            let _e2135 = (_e2125 & 8388607u);
            let _e2136 = (_e2135 | 8388608u);
            let _e2137 = (_e2126 & 8388607u);
            let _e2138 = (_e2137 | 8388608u);
            let _e2139 = (_e2136 < _e2138);
            let _e2143 = bitcast<f32>((_e2137 | 1065353216u));
            let _e2144 = bitcast<u32>(_e2143);
            let _e2149 = bitcast<f32>(((_e2144 & 2147483648u) | (2129859015u - (_e2144 & 2147483647u))));
            let _e2152 = (_e2149 * (2f - (_e2143 * _e2149)));
            let _e2155 = (_e2152 * (2f - (_e2143 * _e2152)));
            let _e2159 = ((bitcast<f32>((_e2135 | 1065353216u)) * _e2155) * select(8388608f, 16777216f, _e2139));
            let _e2164 = select(select(u32(_e2159), 0u, (_e2159 < _e2045)), 4294967295u, (_e2159 > _e2046));
            let _e2170 = bitcast<i32>(((_e2136 << bitcast<u32>((select(23i, 24i, _e2139) & 31i))) - (_e2164 * _e2138)));
            let _e2175 = ((f32((_e2170 >> bitcast<u32>(8i))) * _e2155) * 0.000030517578f);
            let _e2182 = select(0i, select(select(i32(_e2175), i32(-2147483648), (_e2175 < _e2063)), 2147483647i, (_e2175 > _e2064)), (_e2175 == _e2175));
            let _e2184 = (_e2164 + bitcast<u32>(_e2182));
            let _e2185 = bitcast<i32>(_e2138);
            let _e2187 = (_e2170 - (_e2182 * _e2185));
            let _e2188 = (_e2187 < 0i);
            v76_3 = _e2184;
            if _e2188 {
                v76_3 = (_e2184 - 1u);
            }
            let _e2191 = v76_3;
            v77_3 = _e2187;
            if _e2188 {
                v77_3 = (_e2187 + _e2185);
            }
            let _e2194 = v77_3;
            let _e2195 = (_e2194 >= _e2185);
            v78_3 = _e2191;
            if _e2195 {
                v78_3 = (_e2191 + 1u);
            }
            let _e2198 = v78_3;
            v79_3 = _e2194;
            if _e2195 {
                v79_3 = (_e2194 - _e2185);
            }
            let _e2201 = v79_3;
            v80_3 = _e2198;
            if ((_e2201 * 2i) > _e2185) {
                v80_3 = (_e2198 + 1u);
            }
            let _e2206 = v80_3;
            let _e2211 = ((bitcast<i32>(_e2131) - bitcast<i32>(((_e2126 >> bitcast<u32>(23i)) & 255u))) + select(127i, 126i, _e2139));
            v83_3 = u32();
            v84_3 = true;
            if (_e2131 == 0u) {
            } else {
                let _e2213 = (_e2211 <= 0i);
                v82_3 = u32();
                if _e2213 {
                } else {
                    v81_3 = 2139095040u;
                    if (_e2211 >= 255i) {
                    } else {
                        v81_3 = ((bitcast<u32>(_e2211) << bitcast<u32>(23i)) + (_e2206 & 8388607u));
                    }
                    let _e2221 = v81_3;
                    v82_3 = _e2221;
                }
                let _e2223 = v82_3;
                v83_3 = _e2223;
                v84_3 = _e2213;
            }
            let _e2225 = v83_3;
            let _e2227 = v84_3;
            v85_3 = bool();
            if _e183 {
                v86_3 = false;
                if _e185 {
                    if _e185 {
                    } else {
                        break;
                    }
                    let _e2236 = lightbvh_instances.list[_e184].first;
                    let _e2240 = lightbvh_instances.list[_e184].count;
                    v86_3 = ((_e177.member_1[0] - _e2236) < _e2240);
                }
                let _e2243 = v86_3;
                v85_3 = _e2243;
            }
            let _e2232 = v85_3;
            v87_3 = _e2232;
            if _e183 {
            } else {
                v87_3 = (_e177.member_1[0] < _e172);
            }
            let _e2245 = v87_3;
            v88_3 = 0f;
            if _e2245 {
                v88_3 = (_e1990 + bitcast<f32>((((_e2125 ^ _e2126) & 2147483648u) | select(_e2225, 0u, _e2227))));
            }
            let _e2248 = v88_3;
            results_3 = _e2248;
            break;
        }
    }
    let _e2339 = results_3;
    return _e2339;
}

fn lightbvh_light_point(light_2: u32, instance_2: u32, numbers: vec2<f32>) -> LightbvhLightPoint {
    var samples: LightbvhType19_;
    var numbers_1: array<f32, 2>;
    var results_4: LightbvhType38_;
    var v0_4: f32;
    var v1_4: f32;
    var v2_4: f32;
    var v3_4: f32;
    var v4_4: f32;
    var v5_4: f32;
    var v6_4: f32;
    var v7_4: f32;
    var v8_4: f32;
    var v9_4: array<f32, 3>;
    var v10_4: array<f32, 3>;
    var v11_4: f32;
    var v12_4: f32;
    var v13_4: f32;
    var v14_4: LightbvhLight;
    var v15_4: LightbvhLight;
    var v16_4: LightbvhLight;
    var v17_4: u32;
    var v18_4: i32;
    var v19_4: i32;
    var v20_4: u32;
    var v21_4: u32;
    var v22_4: f32;
    var v23_4: u32;
    var v24_4: i32;
    var v25_4: u32;
    var v26_4: i32;
    var v27_4: u32;
    var v28_4: u32;
    var v29_4: u32;
    var v30_4: f32;
    var v31_4: f32;
    var v32_4: array<f32, 3>;

    samples = LightbvhType19_(light_2, instance_2, f32());
    numbers_1 = array<f32, 2>(numbers.x, numbers.y);
    switch bitcast<i32>(0u) {
        default: {
            let _e77 = samples.member;
            let _e80 = samples.member_1;
            let _e82 = select(_e80, 0u, (_e80 == 4294967295u));
            let _e83 = (_e82 < arrayLength((&lightbvh_instances.list)));
            v16_4 = LightbvhLight(array<array<f32, 3>, 3>(array<f32, 3>(0f, 0f, 0f), array<f32, 3>(0f, 0f, 0f), array<f32, 3>(0f, 0f, 0f)), array<f32, 3>(0f, 0f, 0f), 4294967295u, 0u);
            if _e83 {
                if _e83 {
                } else {
                    break;
                }
                let _e86 = lightbvh_instances.list[_e82];
                let _e88 = (_e77 - _e86.first);
                let _e90 = (_e88 + _e86.first_light);
                v15_4 = LightbvhLight(array<array<f32, 3>, 3>(array<f32, 3>(0f, 0f, 0f), array<f32, 3>(0f, 0f, 0f), array<f32, 3>(0f, 0f, 0f)), array<f32, 3>(0f, 0f, 0f), 4294967295u, 0u);
                if (_e88 < _e86.count) {
                    let _e93 = (_e90 < arrayLength((&lightbvh_lights.list)));
                    v14_4 = LightbvhLight(array<array<f32, 3>, 3>(array<f32, 3>(0f, 0f, 0f), array<f32, 3>(0f, 0f, 0f), array<f32, 3>(0f, 0f, 0f)), array<f32, 3>(0f, 0f, 0f), 4294967295u, 0u);
                    if _e93 {
                        if _e93 {
                        } else {
                            break;
                        }
                        let _e96 = lightbvh_lights.list[_e90];
                        let _e115 = (_e86.columns[0][0] * _e96.p[0][0]);
                        let _e116 = (_e86.columns[0][1] * _e96.p[0][0]);
                        let _e117 = (_e86.columns[0][2] * _e96.p[0][0]);
                        let _e127 = (_e86.columns[1][0] * _e96.p[0][1]);
                        let _e128 = (_e86.columns[1][1] * _e96.p[0][1]);
                        let _e129 = (_e86.columns[1][2] * _e96.p[0][1]);
                        let _e139 = (_e86.columns[2][0] * _e96.p[0][2]);
                        let _e140 = (_e86.columns[2][1] * _e96.p[0][2]);
                        let _e141 = (_e86.columns[2][2] * _e96.p[0][2]);
                        let _e199 = (((select(_e115, 0f, (bitcast<f32>((bitcast<u32>(_e115) & 2147483647u)) < 0.0000000000000000000000000000007888609f)) + select(_e127, 0f, (bitcast<f32>((bitcast<u32>(_e127) & 2147483647u)) < 0.0000000000000000000000000000007888609f))) + select(_e139, 0f, (bitcast<f32>((bitcast<u32>(_e139) & 2147483647u)) < 0.0000000000000000000000000000007888609f))) + _e86.translation[0]);
                        let _e200 = (((select(_e116, 0f, (bitcast<f32>((bitcast<u32>(_e116) & 2147483647u)) < 0.0000000000000000000000000000007888609f)) + select(_e128, 0f, (bitcast<f32>((bitcast<u32>(_e128) & 2147483647u)) < 0.0000000000000000000000000000007888609f))) + select(_e140, 0f, (bitcast<f32>((bitcast<u32>(_e140) & 2147483647u)) < 0.0000000000000000000000000000007888609f))) + _e86.translation[1]);
                        let _e201 = (((select(_e117, 0f, (bitcast<f32>((bitcast<u32>(_e117) & 2147483647u)) < 0.0000000000000000000000000000007888609f)) + select(_e129, 0f, (bitcast<f32>((bitcast<u32>(_e129) & 2147483647u)) < 0.0000000000000000000000000000007888609f))) + select(_e141, 0f, (bitcast<f32>((bitcast<u32>(_e141) & 2147483647u)) < 0.0000000000000000000000000000007888609f))) + _e86.translation[2]);
                        let _e202 = -(1099511600000f);
                        v0_4 = _e202;
                        if (_e199 < _e202) {
                        } else {
                            v0_4 = select(_e199, 1099511600000f, (_e199 > 1099511600000f));
                        }
                        let _e207 = v0_4;
                        v1_4 = _e202;
                        if (_e200 < _e202) {
                        } else {
                            v1_4 = select(_e200, 1099511600000f, (_e200 > 1099511600000f));
                        }
                        let _e217 = v1_4;
                        v2_4 = _e202;
                        if (_e201 < _e202) {
                        } else {
                            v2_4 = select(_e201, 1099511600000f, (_e201 > 1099511600000f));
                        }
                        let _e227 = v2_4;
                        let _e237 = (_e86.columns[0][0] * _e96.p[1][0]);
                        let _e238 = (_e86.columns[0][1] * _e96.p[1][0]);
                        let _e239 = (_e86.columns[0][2] * _e96.p[1][0]);
                        let _e240 = (_e86.columns[1][0] * _e96.p[1][1]);
                        let _e241 = (_e86.columns[1][1] * _e96.p[1][1]);
                        let _e242 = (_e86.columns[1][2] * _e96.p[1][1]);
                        let _e243 = (_e86.columns[2][0] * _e96.p[1][2]);
                        let _e244 = (_e86.columns[2][1] * _e96.p[1][2]);
                        let _e245 = (_e86.columns[2][2] * _e96.p[1][2]);
                        let _e297 = (((select(_e237, 0f, (bitcast<f32>((bitcast<u32>(_e237) & 2147483647u)) < 0.0000000000000000000000000000007888609f)) + select(_e240, 0f, (bitcast<f32>((bitcast<u32>(_e240) & 2147483647u)) < 0.0000000000000000000000000000007888609f))) + select(_e243, 0f, (bitcast<f32>((bitcast<u32>(_e243) & 2147483647u)) < 0.0000000000000000000000000000007888609f))) + _e86.translation[0]);
                        let _e298 = (((select(_e238, 0f, (bitcast<f32>((bitcast<u32>(_e238) & 2147483647u)) < 0.0000000000000000000000000000007888609f)) + select(_e241, 0f, (bitcast<f32>((bitcast<u32>(_e241) & 2147483647u)) < 0.0000000000000000000000000000007888609f))) + select(_e244, 0f, (bitcast<f32>((bitcast<u32>(_e244) & 2147483647u)) < 0.0000000000000000000000000000007888609f))) + _e86.translation[1]);
                        let _e299 = (((select(_e239, 0f, (bitcast<f32>((bitcast<u32>(_e239) & 2147483647u)) < 0.0000000000000000000000000000007888609f)) + select(_e242, 0f, (bitcast<f32>((bitcast<u32>(_e242) & 2147483647u)) < 0.0000000000000000000000000000007888609f))) + select(_e245, 0f, (bitcast<f32>((bitcast<u32>(_e245) & 2147483647u)) < 0.0000000000000000000000000000007888609f))) + _e86.translation[2]);
                        v3_4 = _e202;
                        if (_e297 < _e202) {
                        } else {
                            v3_4 = select(_e297, 1099511600000f, (_e297 > 1099511600000f));
                        }
                        let _e304 = v3_4;
                        v4_4 = _e202;
                        if (_e298 < _e202) {
                        } else {
                            v4_4 = select(_e298, 1099511600000f, (_e298 > 1099511600000f));
                        }
                        let _e314 = v4_4;
                        v5_4 = _e202;
                        if (_e299 < _e202) {
                        } else {
                            v5_4 = select(_e299, 1099511600000f, (_e299 > 1099511600000f));
                        }
                        let _e324 = v5_4;
                        let _e330 = array<f32, 3>(select(_e304, 0f, (bitcast<f32>((bitcast<u32>(_e304) & 2147483647u)) < 0.0000000000000000000000000000007888609f)), select(_e314, 0f, (bitcast<f32>((bitcast<u32>(_e314) & 2147483647u)) < 0.0000000000000000000000000000007888609f)), select(_e324, 0f, (bitcast<f32>((bitcast<u32>(_e324) & 2147483647u)) < 0.0000000000000000000000000000007888609f)));
                        let _e334 = (_e86.columns[0][0] * _e96.p[2][0]);
                        let _e335 = (_e86.columns[0][1] * _e96.p[2][0]);
                        let _e336 = (_e86.columns[0][2] * _e96.p[2][0]);
                        let _e337 = (_e86.columns[1][0] * _e96.p[2][1]);
                        let _e338 = (_e86.columns[1][1] * _e96.p[2][1]);
                        let _e339 = (_e86.columns[1][2] * _e96.p[2][1]);
                        let _e340 = (_e86.columns[2][0] * _e96.p[2][2]);
                        let _e341 = (_e86.columns[2][1] * _e96.p[2][2]);
                        let _e342 = (_e86.columns[2][2] * _e96.p[2][2]);
                        let _e394 = (((select(_e334, 0f, (bitcast<f32>((bitcast<u32>(_e334) & 2147483647u)) < 0.0000000000000000000000000000007888609f)) + select(_e337, 0f, (bitcast<f32>((bitcast<u32>(_e337) & 2147483647u)) < 0.0000000000000000000000000000007888609f))) + select(_e340, 0f, (bitcast<f32>((bitcast<u32>(_e340) & 2147483647u)) < 0.0000000000000000000000000000007888609f))) + _e86.translation[0]);
                        let _e395 = (((select(_e335, 0f, (bitcast<f32>((bitcast<u32>(_e335) & 2147483647u)) < 0.0000000000000000000000000000007888609f)) + select(_e338, 0f, (bitcast<f32>((bitcast<u32>(_e338) & 2147483647u)) < 0.0000000000000000000000000000007888609f))) + select(_e341, 0f, (bitcast<f32>((bitcast<u32>(_e341) & 2147483647u)) < 0.0000000000000000000000000000007888609f))) + _e86.translation[1]);
                        let _e396 = (((select(_e336, 0f, (bitcast<f32>((bitcast<u32>(_e336) & 2147483647u)) < 0.0000000000000000000000000000007888609f)) + select(_e339, 0f, (bitcast<f32>((bitcast<u32>(_e339) & 2147483647u)) < 0.0000000000000000000000000000007888609f))) + select(_e342, 0f, (bitcast<f32>((bitcast<u32>(_e342) & 2147483647u)) < 0.0000000000000000000000000000007888609f))) + _e86.translation[2]);
                        v6_4 = _e202;
                        if (_e394 < _e202) {
                        } else {
                            v6_4 = select(_e394, 1099511600000f, (_e394 > 1099511600000f));
                        }
                        let _e401 = v6_4;
                        v7_4 = _e202;
                        if (_e395 < _e202) {
                        } else {
                            v7_4 = select(_e395, 1099511600000f, (_e395 > 1099511600000f));
                        }
                        let _e411 = v7_4;
                        v8_4 = _e202;
                        if (_e396 < _e202) {
                        } else {
                            v8_4 = select(_e396, 1099511600000f, (_e396 > 1099511600000f));
                        }
                        let _e421 = v8_4;
                        let _e427 = array<f32, 3>(select(_e401, 0f, (bitcast<f32>((bitcast<u32>(_e401) & 2147483647u)) < 0.0000000000000000000000000000007888609f)), select(_e411, 0f, (bitcast<f32>((bitcast<u32>(_e411) & 2147483647u)) < 0.0000000000000000000000000000007888609f)), select(_e421, 0f, (bitcast<f32>((bitcast<u32>(_e421) & 2147483647u)) < 0.0000000000000000000000000000007888609f)));
                        let _e430 = ((_e86.mirrored & 1u) != 0u);
                        v9_4 = _e330;
                        if _e430 {
                            v9_4 = _e427;
                        }
                        let _e432 = v9_4;
                        v10_4 = _e427;
                        if _e430 {
                            v10_4 = _e330;
                        }
                        let _e434 = v10_4;
                        let _e436 = (_e96.p[1][0] - _e96.p[0][0]);
                        let _e437 = (_e96.p[1][1] - _e96.p[0][1]);
                        let _e438 = (_e96.p[1][2] - _e96.p[0][2]);
                        let _e439 = (_e96.p[2][0] - _e96.p[0][0]);
                        let _e440 = (_e96.p[2][1] - _e96.p[0][1]);
                        let _e441 = (_e96.p[2][2] - _e96.p[0][2]);
                        let _e444 = bitcast<f32>((bitcast<u32>(_e436) & 2147483647u));
                        let _e447 = bitcast<f32>((bitcast<u32>(_e437) & 2147483647u));
                        let _e450 = bitcast<f32>((bitcast<u32>(_e438) & 2147483647u));
                        let _e453 = bitcast<f32>((bitcast<u32>(_e439) & 2147483647u));
                        let _e456 = bitcast<f32>((bitcast<u32>(_e440) & 2147483647u));
                        let _e459 = bitcast<f32>((bitcast<u32>(_e441) & 2147483647u));
                        let _e468 = bitcast<f32>((bitcast<u32>(select(_e453, _e444, (_e444 > _e453))) & 2147483647u));
                        let _e471 = bitcast<f32>((bitcast<u32>(select(_e456, _e447, (_e447 > _e456))) & 2147483647u));
                        let _e474 = bitcast<f32>((bitcast<u32>(select(_e459, _e450, (_e450 > _e459))) & 2147483647u));
                        let _e476 = select(_e471, _e468, (_e468 > _e471));
                        let _e484 = (bitcast<i32>(((bitcast<u32>(select(_e474, _e476, (_e476 > _e474))) >> bitcast<u32>(23i)) & 255u)) - 127i);
                        let _e486 = select(-127i, _e484, (_e484 > -127i));
                        let _e487 = -(_e486);
                        let _e489 = select(_e487, -126i, (_e487 < -126i));
                        let _e496 = bitcast<f32>((bitcast<u32>((select(_e489, 127i, (_e489 > 127i)) + 127i)) << bitcast<u32>(23i)));
                        let _e497 = (_e436 * _e496);
                        let _e498 = (_e437 * _e496);
                        let _e499 = (_e438 * _e496);
                        let _e500 = (_e439 * _e496);
                        let _e501 = (_e440 * _e496);
                        let _e502 = (_e441 * _e496);
                        let _e514 = bitcast<f32>((bitcast<u32>(((_e498 * _e502) - (_e499 * _e501))) & 2147483647u));
                        let _e517 = bitcast<f32>((bitcast<u32>(((_e499 * _e500) - (_e497 * _e502))) & 2147483647u));
                        let _e520 = bitcast<f32>((bitcast<u32>(((_e497 * _e501) - (_e498 * _e500))) & 2147483647u));
                        let _e522 = select(_e517, _e514, (_e514 > _e517));
                        let _e530 = (bitcast<i32>(((bitcast<u32>(select(_e520, _e522, (_e522 > _e520))) >> bitcast<u32>(23i)) & 255u)) - 127i);
                        let _e548 = (((select(-127i, _e530, (_e530 > -127i)) >= -100i) && (_e486 > -127i)) && ((((0.2126f * _e96.radiance[0]) + (0.7152f * _e96.radiance[1])) + (0.0722f * _e96.radiance[2])) > 0f));
                        let _e551 = (_e96.radiance[0] * _e86.radiance[0]);
                        v11_4 = 0.0000000000000000000000000000007888609f;
                        if (_e551 < 0.0000000000000000000000000000007888609f) {
                        } else {
                            v11_4 = select(_e551, 1267650600000000000000000000000f, (_e551 > 1267650600000000000000000000000f));
                        }
                        let _e556 = v11_4;
                        let _e564 = (_e96.radiance[1] * _e86.radiance[1]);
                        v12_4 = 0.0000000000000000000000000000007888609f;
                        if (_e564 < 0.0000000000000000000000000000007888609f) {
                        } else {
                            v12_4 = select(_e564, 1267650600000000000000000000000f, (_e564 > 1267650600000000000000000000000f));
                        }
                        let _e569 = v12_4;
                        let _e577 = (_e96.radiance[2] * _e86.radiance[2]);
                        v13_4 = 0.0000000000000000000000000000007888609f;
                        if (_e577 < 0.0000000000000000000000000000007888609f) {
                        } else {
                            v13_4 = select(_e577, 1267650600000000000000000000000f, (_e577 > 1267650600000000000000000000000f));
                        }
                        let _e582 = v13_4;
                        v14_4 = LightbvhLight(array<array<f32, 3>, 3>(array<f32, 3>(select(_e207, 0f, (bitcast<f32>((bitcast<u32>(_e207) & 2147483647u)) < 0.0000000000000000000000000000007888609f)), select(_e217, 0f, (bitcast<f32>((bitcast<u32>(_e217) & 2147483647u)) < 0.0000000000000000000000000000007888609f)), select(_e227, 0f, (bitcast<f32>((bitcast<u32>(_e227) & 2147483647u)) < 0.0000000000000000000000000000007888609f))), _e432, _e434), array<f32, 3>(select(0f, _e556, (((_e96.radiance[0] > 0f) && (_e86.radiance[0] > 0f)) && _e548)), select(0f, _e569, (((_e96.radiance[1] > 0f) && (_e86.radiance[1] > 0f)) && _e548)), select(0f, _e582, (((_e96.radiance[2] > 0f) && (_e86.radiance[2] > 0f)) && _e548))), _e82, _e96.flags);
                    }
                    let _e592 = v14_4;
                    v15_4 = _e592;
                }
                let _e594 = v15_4;
                v16_4 = _e594;
            }
            let _e596 = v16_4;
            let _e598 = numbers_1;
            let _e609 = (_e596.p[1][0] - _e596.p[0][0]);
            let _e610 = (_e596.p[1][1] - _e596.p[0][1]);
            let _e611 = (_e596.p[1][2] - _e596.p[0][2]);
            let _e617 = (_e596.p[2][0] - _e596.p[0][0]);
            let _e618 = (_e596.p[2][1] - _e596.p[0][1]);
            let _e619 = (_e596.p[2][2] - _e596.p[0][2]);
            let _e622 = bitcast<f32>((bitcast<u32>(_e609) & 2147483647u));
            let _e625 = bitcast<f32>((bitcast<u32>(_e610) & 2147483647u));
            let _e628 = bitcast<f32>((bitcast<u32>(_e611) & 2147483647u));
            let _e631 = bitcast<f32>((bitcast<u32>(_e617) & 2147483647u));
            let _e634 = bitcast<f32>((bitcast<u32>(_e618) & 2147483647u));
            let _e637 = bitcast<f32>((bitcast<u32>(_e619) & 2147483647u));
            let _e646 = bitcast<f32>((bitcast<u32>(select(_e631, _e622, (_e622 > _e631))) & 2147483647u));
            let _e649 = bitcast<f32>((bitcast<u32>(select(_e634, _e625, (_e625 > _e634))) & 2147483647u));
            let _e652 = bitcast<f32>((bitcast<u32>(select(_e637, _e628, (_e628 > _e637))) & 2147483647u));
            let _e654 = select(_e649, _e646, (_e646 > _e649));
            let _e662 = (bitcast<i32>(((bitcast<u32>(select(_e652, _e654, (_e654 > _e652))) >> bitcast<u32>(23i)) & 255u)) - 127i);
            let _e664 = select(-127i, _e662, (_e662 > -127i));
            let _e665 = -(_e664);
            let _e667 = select(_e665, -126i, (_e665 < -126i));
            let _e674 = bitcast<f32>((bitcast<u32>((select(_e667, 127i, (_e667 > 127i)) + 127i)) << bitcast<u32>(23i)));
            let _e675 = (_e609 * _e674);
            let _e676 = (_e610 * _e674);
            let _e677 = (_e611 * _e674);
            let _e678 = (_e617 * _e674);
            let _e679 = (_e618 * _e674);
            let _e680 = (_e619 * _e674);
            let _e683 = ((_e676 * _e680) - (_e677 * _e679));
            let _e686 = ((_e677 * _e678) - (_e675 * _e680));
            let _e689 = ((_e675 * _e679) - (_e676 * _e678));
            let _e692 = bitcast<f32>((bitcast<u32>(_e683) & 2147483647u));
            let _e695 = bitcast<f32>((bitcast<u32>(_e686) & 2147483647u));
            let _e698 = bitcast<f32>((bitcast<u32>(_e689) & 2147483647u));
            let _e700 = select(_e695, _e692, (_e692 > _e695));
            let _e708 = (bitcast<i32>(((bitcast<u32>(select(_e698, _e700, (_e700 > _e698))) >> bitcast<u32>(23i)) & 255u)) - 127i);
            let _e710 = select(-127i, _e708, (_e708 > -127i));
            let _e711 = (_e710 >= -100i);
            let _e714 = -(_e710);
            let _e716 = select(_e714, -126i, (_e714 < -126i));
            let _e723 = bitcast<f32>((bitcast<u32>((select(_e716, 127i, (_e716 > 127i)) + 127i)) << bitcast<u32>(23i)));
            let _e728 = (0u - select(0u, 1u, (_e711 && (_e664 > -127i))));
            let _e731 = bitcast<f32>((bitcast<u32>((_e683 * _e723)) & _e728));
            let _e734 = bitcast<f32>((bitcast<u32>((_e686 * _e723)) & _e728));
            let _e739 = bitcast<f32>((1065353216u ^ ((bitcast<u32>((_e689 * _e723)) ^ 1065353216u) & _e728)));
            let _e745 = bitcast<u32>((((_e731 * _e731) + (_e734 * _e734)) + (_e739 * _e739)));
            let _e748 = ((_e745 >> bitcast<u32>(23i)) & 255u);
            let _e750 = ((_e748 & 1u) ^ 1u);
            let _e751 = (_e745 & 8388607u);
            let _e757 = bitcast<f32>((_e751 | (1065353216u + (_e750 << bitcast<u32>(23i)))));
            let _e763 = bitcast<f32>((1597463007u - (bitcast<u32>(_e757) >> bitcast<u32>(1i))));
            let _e764 = (0.5f * _e757);
            let _e768 = (_e763 * (1.5f - ((_e764 * _e763) * _e763)));
            let _e772 = (_e768 * (1.5f - ((_e764 * _e768) * _e768)));
            let _e776 = (_e772 * (1.5f - ((_e764 * _e772) * _e772)));
            let _e778 = ((_e757 * _e776) * 8388608f);
            let _e779 = bitcast<f32>(0u);
            let _e780 = bitcast<f32>(1333788671u);
            let _e785 = select(select(u32(_e778), 0u, (_e778 < _e779)), 4294967295u, (_e778 > _e780));
            let _e788 = ((_e751 | 8388608u) << bitcast<u32>(((23u + _e750) & 31u)));
            let _e796 = ((f32((bitcast<i32>((_e788 - (_e785 * _e785))) >> bitcast<u32>(8i))) * _e776) * 0.000015258789f);
            let _e797 = bitcast<f32>(3472883712u);
            let _e798 = bitcast<f32>(1325400063u);
            let _e807 = (_e785 + bitcast<u32>(select(0i, select(select(i32(_e796), i32(-2147483648), (_e796 < _e797)), 2147483647i, (_e796 > _e798)), (_e796 == _e796))));
            let _e810 = bitcast<i32>((_e788 - (_e807 * _e807)));
            let _e811 = (_e810 < 0i);
            v17_4 = _e807;
            if _e811 {
                v17_4 = (_e807 - 1u);
            }
            let _e814 = v17_4;
            v18_4 = _e810;
            if _e811 {
                v18_4 = (_e810 + ((2i * bitcast<i32>(_e814)) + 1i));
            }
            let _e820 = v18_4;
            let _e822 = (2i * bitcast<i32>(_e814));
            let _e823 = (_e820 > _e822);
            v19_4 = _e820;
            if _e823 {
                v19_4 = (_e820 - (_e822 + 1i));
            }
            let _e827 = v19_4;
            v20_4 = _e814;
            if _e823 {
                v20_4 = (_e814 + 1u);
            }
            let _e830 = v20_4;
            v21_4 = _e830;
            if (_e827 > bitcast<i32>(_e830)) {
                v21_4 = (_e830 + 1u);
            }
            let _e835 = v21_4;
            v22_4 = 0f;
            if (bitcast<i32>(_e745) < 8388608i) {
            } else {
                v22_4 = bitcast<f32>((((((_e748 + 127u) - _e750) >> bitcast<u32>(1i)) << bitcast<u32>(23i)) + (_e835 - 8388608u)));
            }
            let _e848 = v22_4;
            let _e849 = bitcast<u32>(_e848);
            let _e855 = (_e849 & 8388607u);
            let _e856 = (_e855 | 8388608u);
            let _e857 = (8388608u < _e856);
            let _e861 = bitcast<f32>((_e855 | 1065353216u));
            let _e862 = bitcast<u32>(_e861);
            let _e867 = bitcast<f32>(((_e862 & 2147483648u) | (2129859015u - (_e862 & 2147483647u))));
            let _e870 = (_e867 * (2f - (_e861 * _e867)));
            let _e873 = (_e870 * (2f - (_e861 * _e870)));
            let _e876 = ((bitcast<f32>(1065353216u) * _e873) * select(8388608f, 16777216f, _e857));
            let _e881 = select(select(u32(_e876), 0u, (_e876 < _e779)), 4294967295u, (_e876 > _e780));
            let _e887 = bitcast<i32>(((8388608u << bitcast<u32>((select(23i, 24i, _e857) & 31i))) - (_e881 * _e856)));
            let _e892 = ((f32((_e887 >> bitcast<u32>(8i))) * _e873) * 0.000030517578f);
            let _e899 = select(0i, select(select(i32(_e892), i32(-2147483648), (_e892 < _e797)), 2147483647i, (_e892 > _e798)), (_e892 == _e892));
            let _e901 = (_e881 + bitcast<u32>(_e899));
            let _e902 = bitcast<i32>(_e856);
            let _e904 = (_e887 - (_e899 * _e902));
            let _e905 = (_e904 < 0i);
            v23_4 = _e901;
            if _e905 {
                v23_4 = (_e901 - 1u);
            }
            let _e908 = v23_4;
            v24_4 = _e904;
            if _e905 {
                v24_4 = (_e904 + _e902);
            }
            let _e911 = v24_4;
            let _e912 = (_e911 >= _e902);
            v25_4 = _e908;
            if _e912 {
                v25_4 = (_e908 + 1u);
            }
            let _e915 = v25_4;
            v26_4 = _e911;
            if _e912 {
                v26_4 = (_e911 - _e902);
            }
            let _e918 = v26_4;
            v27_4 = _e915;
            if ((_e918 * 2i) > _e902) {
                v27_4 = (_e915 + 1u);
            }
            let _e923 = v27_4;
            let _e927 = ((127i - bitcast<i32>(((_e849 >> bitcast<u32>(23i)) & 255u))) + select(127i, 126i, _e857));
            let _e928 = (_e927 <= 0i);
            v29_4 = u32();
            if _e928 {
            } else {
                v28_4 = 2139095040u;
                if (_e927 >= 255i) {
                } else {
                    v28_4 = ((bitcast<u32>(_e927) << bitcast<u32>(23i)) + (_e923 & 8388607u));
                }
                let _e936 = v28_4;
                v29_4 = _e936;
            }
            let _e938 = v29_4;
            let _e941 = bitcast<f32>((((1065353216u ^ _e849) & 2147483648u) | select(_e938, 0u, _e928)));
            let _e945 = -(((_e710 + _e664) + _e664));
            let _e947 = select(_e945, -126i, (_e945 < -126i));
            let _e955 = ((_e941 + _e941) * bitcast<f32>((bitcast<u32>((select(_e947, 127i, (_e947 > 127i)) + 127i)) << bitcast<u32>(23i))));
            let _e959 = ((_e598[0] + _e598[1]) > 1f);
            v30_4 = _e598[0];
            if _e959 {
                v30_4 = (1f - _e598[0]);
            }
            let _e962 = v30_4;
            v31_4 = _e598[1];
            if _e959 {
                v31_4 = (1f - _e598[1]);
            }
            let _e965 = v31_4;
            let _e966 = (_e609 * _e962);
            let _e967 = (_e610 * _e962);
            let _e968 = (_e611 * _e962);
            let _e987 = (_e617 * _e965);
            let _e988 = (_e618 * _e965);
            let _e989 = (_e619 * _e965);
            v32_4 = array<f32, 3>(0f, 0f, 0f);
            if _e711 {
                v32_4 = array<f32, 3>((_e731 * _e941), (_e734 * _e941), (_e739 * _e941));
            }
            let _e1019 = v32_4;
            results_4 = LightbvhType38_(array<f32, 3>(((_e596.p[0][0] + select(_e966, 0f, (bitcast<f32>((bitcast<u32>(_e966) & 2147483647u)) < 0.000000000000000000000000000000098607613f))) + select(_e987, 0f, (bitcast<f32>((bitcast<u32>(_e987) & 2147483647u)) < 0.000000000000000000000000000000098607613f))), ((_e596.p[0][1] + select(_e967, 0f, (bitcast<f32>((bitcast<u32>(_e967) & 2147483647u)) < 0.000000000000000000000000000000098607613f))) + select(_e988, 0f, (bitcast<f32>((bitcast<u32>(_e988) & 2147483647u)) < 0.000000000000000000000000000000098607613f))), ((_e596.p[0][2] + select(_e968, 0f, (bitcast<f32>((bitcast<u32>(_e968) & 2147483647u)) < 0.000000000000000000000000000000098607613f))) + select(_e989, 0f, (bitcast<f32>((bitcast<u32>(_e989) & 2147483647u)) < 0.000000000000000000000000000000098607613f)))), select(0f, select(1329228000000000000000000000000000000f, _e955, (_e955 < 1329228000000000000000000000000000000f)), _e711), _e1019, _e596.flags, _e596.radiance);
            break;
        }
    }
    let _e1056 = results_4;
    return LightbvhLightPoint(vec3<f32>(_e1056.member[0], _e1056.member[1], _e1056.member[2]), _e1056.member_1, vec3<f32>(_e1056.member_2[0], _e1056.member_2[1], _e1056.member_2[2]), _e1056.member_3, vec3<f32>(_e1056.member_4[0], _e1056.member_4[1], _e1056.member_4[2]));
}

