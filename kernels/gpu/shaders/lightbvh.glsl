// Functions of lightbvh (docs/shaders.md). Written by `print-functions` from compiled kernels; edits are lost.

struct LightbvhTree {
    uint root;
    uint trail_words;
    uint live;
    uint lights;
    uint depth;
    uint top;
    uint above;
    uint places;
    uint parts;
};
struct LightbvhInstance {
    uint root;
    uint blas;
    uint first;
    uint first_light;
    uint count;
    uint listed;
    float columns[3][3];
    float translation[3];
    float inverse_[3][3];
    float per_inverse;
    float flux;
    float radiance[3];
    uint mask;
    uint mirrored;
};
struct LightbvhType14_ {
    float member[3];
    float member_1[3];
};
struct LightbvhType16_ {
    LightbvhType14_ member;
    uint member_1[2];
};
struct LightbvhType19_ {
    uint member;
    uint member_1;
    float member_2;
};
struct LightbvhLightSample {
    uint light;
    uint instance;
    float pmf;
};
struct LightbvhType23_ {
    uint member;
    uint member_1;
};
struct LightbvhType24_ {
    LightbvhType23_ member;
    LightbvhType23_ member_1;
};
struct LightbvhType25_ {
    float member;
    float member_1;
};
struct LightbvhType26_ {
    LightbvhType24_ member;
    LightbvhType23_ member_1;
    LightbvhType14_ member_2;
    LightbvhType25_ member_3;
    uint member_4;
    uint member_5;
    uint member_6;
    uint member_7;
    uint member_8;
    uint member_9;
    uint member_10;
    uint member_11;
    bool member_12;
    bool member_13;
};
struct LightbvhType27_ {
    uint member;
    uint member_1;
    LightbvhType26_ member_2;
};
struct LightbvhLight {
    float p[3][3];
    float radiance[3];
    uint mesh;
    uint flags;
};
struct LightbvhType34_ {
    float member[3];
    float member_1;
    float member_2[3];
    uint member_3;
    float member_4[3];
};
struct LightbvhLightPoint {
    vec3 p;
    float density;
    vec3 normal;
    uint flags;
    vec3 radiance;
};
layout(std140, set = 0, binding = 4) uniform LightbvhTree_block_0Compute { LightbvhTree lightbvh_tree; };

layout(std430, set = 0, binding = 0) readonly buffer LightbvhNodes_block_1Compute {
    uint list[][6][8];
} lightbvh_nodes;

layout(std430, set = 0, binding = 1) readonly buffer LightbvhInstances_block_2Compute {
    LightbvhInstance list[];
} lightbvh_instances;

layout(std430, set = 0, binding = 2) readonly buffer LightbvhTrails_block_3Compute {
    uint list[];
} lightbvh_trails;

layout(std430, set = 0, binding = 3) readonly buffer LightbvhLights_block_4Compute {
    LightbvhLight list[];
} lightbvh_lights;


LightbvhLightSample lightbvh_sample(vec3 p, vec3 n, uvec2 number) {
    LightbvhType16_ queries = LightbvhType16_(LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), uint[2](0u, 0u));
    LightbvhType19_ results = LightbvhType19_(0u, 0u, 0.0);
    float v0_[8] = float[8](0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    uint v1_ = 0u;
    uint v2_ = 0u;
    uint v3_ = 0u;
    uint v4_ = 0u;
    uint v5_ = 0u;
    uint v6_ = 0u;
    uint v7_ = 0u;
    uint v8_ = 0u;
    uint v9_ = 0u;
    uint v10_ = 0u;
    uint v11_ = 0u;
    uint v12_ = 0u;
    bool v13_ = false;
    uint v14_ = 0u;
    uint v15_ = 0u;
    uint v16_ = 0u;
    bool v17_ = false;
    bool v18_ = false;
    LightbvhType24_ v19_ = LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u));
    uint v20_ = 0u;
    uint v21_ = 0u;
    uint v22_ = 0u;
    uint v23_ = 0u;
    bool v24_ = false;
    uint v25_ = 0u;
    LightbvhType23_ v26_ = LightbvhType23_(0u, 0u);
    uint v27_ = 0u;
    uint v28_ = 0u;
    uint v29_ = 0u;
    LightbvhType23_ v30_ = LightbvhType23_(0u, 0u);
    uint v31_ = 0u;
    uint v32_ = 0u;
    LightbvhType23_ v33_ = LightbvhType23_(0u, 0u);
    uint v34_ = 0u;
    bool v35_ = false;
    bool v36_ = false;
    LightbvhType23_ v37_ = LightbvhType23_(0u, 0u);
    bool v38_ = false;
    LightbvhType24_ v39_ = LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u));
    bool v40_ = false;
    LightbvhType24_ v41_ = LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u));
    uint v42_ = 0u;
    uint v43_ = 0u;
    bool v44_ = false;
    LightbvhType27_ v45_ = LightbvhType27_(0u, 0u, LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false));
    bool v46_ = false;
    LightbvhType23_ v47_ = LightbvhType23_(0u, 0u);
    LightbvhType23_ v48_ = LightbvhType23_(0u, 0u);
    LightbvhType23_ v49_ = LightbvhType23_(0u, 0u);
    LightbvhType23_ v50_ = LightbvhType23_(0u, 0u);
    LightbvhType23_ v51_ = LightbvhType23_(0u, 0u);
    bool v52_ = false;
    uint v53_ = 0u;
    uint v54_ = 0u;
    uint v55_ = 0u;
    uint v56_ = 0u;
    int v57_ = 0;
    uint v58_ = 0u;
    bool v59_ = false;
    LightbvhType27_ v60_ = LightbvhType27_(0u, 0u, LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false));
    uint v61_ = 0u;
    uint v62_ = 0u;
    LightbvhType27_ v63_ = LightbvhType27_(0u, 0u, LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false));
    float v64_ = 0.0;
    float v65_ = 0.0;
    float v66_ = 0.0;
    float v67_ = 0.0;
    LightbvhType27_ v68_ = LightbvhType27_(0u, 0u, LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false));
    bool v69_ = false;
    LightbvhType27_ v70_ = LightbvhType27_(0u, 0u, LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false));
    bool v71_ = false;
    bool v72_ = false;
    LightbvhType27_ v73_ = LightbvhType27_(0u, 0u, LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false));
    LightbvhType27_ v74_ = LightbvhType27_(0u, 0u, LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false));
    LightbvhType27_ v75_ = LightbvhType27_(0u, 0u, LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false));
    LightbvhType27_ v76_ = LightbvhType27_(0u, 0u, LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false));
    uint v77_ = 0u;
    uint v78_ = 0u;
    LightbvhType27_ v79_ = LightbvhType27_(0u, 0u, LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false));
    LightbvhType27_ v80_ = LightbvhType27_(0u, 0u, LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false));
    float v81_ = 0.0;
    uint v82_ = 0u;
    uint v83_ = 0u;
    bool v84_ = false;
    uint v85_ = 0u;
    int v86_ = 0;
    uint v87_ = 0u;
    int v88_ = 0;
    uint v89_ = 0u;
    uint v90_ = 0u;
    uint v91_ = 0u;
    uint v92_ = 0u;
    bool v93_ = false;
    uint v94_ = 0u;
    int v95_ = 0;
    uint v96_ = 0u;
    int v97_ = 0;
    uint v98_ = 0u;
    uint v99_ = 0u;
    uint v100_ = 0u;
    uint v101_ = 0u;
    bool v102_ = false;
    LightbvhType19_ v103_ = LightbvhType19_(0u, 0u, 0.0);
    queries = LightbvhType16_(LightbvhType14_(float[3](p.x, p.y, p.z), float[3](n.x, n.y, n.z)), uint[2](number.x, number.y));
    do {
        uint _e141 = uint(lightbvh_nodes.list.length());
        uint _e144 = uint(lightbvh_instances.list.length());
        uint _e147 = uint(lightbvh_trails.list.length());
        uint _e150 = lightbvh_tree.top;
        uint _e153 = lightbvh_tree.root;
        uint _e156 = lightbvh_tree.above;
        uint _e159 = lightbvh_tree.places;
        uint _e162 = lightbvh_tree.parts;
        uint _e165 = lightbvh_tree.trail_words;
        uint _e168 = lightbvh_tree.live;
        uint _e171 = lightbvh_tree.lights;
        uint _e174 = lightbvh_tree.depth;
        LightbvhType16_ _e176 = queries;
        v40_ = false;
        v41_ = LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u));
        v42_ = 4294967295u;
        v43_ = 4294967295u;
        if (((_e176.member_1[0] >> 10u) < 65536u)) {
            uint _e191 = ((_e176.member_1[0] << 6u) | ((_e176.member_1[1] >> uint(1)) >> 25u));
            uint _e193 = (_e176.member_1[1] << 6u);
            bool _e194 = (_e168 > 0u);
            v1_ = 0u;
            v2_ = 0u;
            if (_e194) {
                uint _e247 = (_e193 >> uint(16));
                uint _e248 = (_e193 & 65535u);
                uint _e250 = (_e168 >> uint(16));
                uint _e251 = (_e168 & 65535u);
                uint _e256 = ((_e247 * _e251) + ((_e248 * _e251) >> uint(16)));
                uint _e267 = (_e193 * _e168);
                uint _e269 = (_e191 >> uint(16));
                uint _e270 = (_e191 & 65535u);
                uint _e275 = ((_e269 * _e251) + ((_e270 * _e251) >> uint(16)));
                uint _e286 = (_e191 * _e168);
                uint _e287 = (_e286 + (((_e247 * _e250) + (_e256 >> uint(16))) + (((_e248 * _e250) + (_e256 & 65535u)) >> uint(16))));
                uint _e290 = ((((_e269 * _e250) + (_e275 >> uint(16))) + (((_e270 * _e250) + (_e275 & 65535u)) >> uint(16))) + ((_e287 < _e286) ? 1u : 0u));
                v7_ = 4294967295u;
                v8_ = 4294967295u;
                if ((_e290 < _e144)) {
                    uint _e294 = lightbvh_instances.list[_e290].listed;
                    v5_ = 4294967295u;
                    v6_ = 4294967295u;
                    if ((_e294 < _e144)) {
                        uint _e298 = lightbvh_instances.list[_e294].count;
                        bool _e299 = (_e298 > 0u);
                        v4_ = 4294967295u;
                        if (_e299) {
                            uint _e302 = lightbvh_instances.list[_e294].first;
                            uint _e304 = (_e267 >> uint(16));
                            uint _e305 = (_e267 & 65535u);
                            uint _e307 = (_e298 >> uint(16));
                            uint _e308 = (_e298 & 65535u);
                            uint _e313 = ((_e304 * _e308) + ((_e305 * _e308) >> uint(16)));
                            uint _e325 = (_e287 >> uint(16));
                            uint _e326 = (_e287 & 65535u);
                            uint _e331 = ((_e325 * _e308) + ((_e326 * _e308) >> uint(16)));
                            uint _e342 = (_e287 * _e298);
                            v4_ = (_e302 + ((((_e325 * _e307) + (_e331 >> uint(16))) + (((_e326 * _e307) + (_e331 & 65535u)) >> uint(16))) + (((_e342 + (((_e304 * _e307) + (_e313 >> uint(16))) + (((_e305 * _e307) + (_e313 & 65535u)) >> uint(16)))) < _e342) ? 1u : 0u)));
                        }
                        uint _e349 = v4_;
                        v5_ = _e349;
                        v6_ = (_e299 ? _e294 : 4294967295u);
                    }
                    uint _e352 = v5_;
                    uint _e354 = v6_;
                    v7_ = _e352;
                    v8_ = _e354;
                }
                uint _e356 = v7_;
                uint _e358 = v8_;
                v1_ = _e356;
                v2_ = _e358;
            }
            uint _e196 = v1_;
            uint _e198 = v2_;
            v9_ = _e196;
            v10_ = _e198;
            if (_e194) {
            } else {
                v3_ = 4294967295u;
                if ((_e171 > 0u)) {
                    uint _e201 = (_e193 >> uint(16));
                    uint _e202 = (_e193 & 65535u);
                    uint _e204 = (_e171 >> uint(16));
                    uint _e205 = (_e171 & 65535u);
                    uint _e210 = ((_e201 * _e205) + ((_e202 * _e205) >> uint(16)));
                    uint _e222 = (_e191 >> uint(16));
                    uint _e223 = (_e191 & 65535u);
                    uint _e228 = ((_e222 * _e205) + ((_e223 * _e205) >> uint(16)));
                    uint _e239 = (_e191 * _e171);
                    v3_ = ((((_e222 * _e204) + (_e228 >> uint(16))) + (((_e223 * _e204) + (_e228 & 65535u)) >> uint(16))) + (((_e239 + (((_e201 * _e204) + (_e210 >> uint(16))) + (((_e202 * _e204) + (_e210 & 65535u)) >> uint(16)))) < _e239) ? 1u : 0u));
                }
                uint _e245 = v3_;
                v9_ = _e245;
                v10_ = 4294967295u;
            }
            uint _e360 = v9_;
            uint _e362 = v10_;
            bool _e363 = (_e362 < _e144);
            v12_ = 0u;
            v13_ = true;
            if (_e363) {
                v11_ = 0u;
                if (_e194) {
                    uint _e366 = lightbvh_instances.list[_e362].first;
                    uint _e370 = lightbvh_instances.list[_e362].first_light;
                    v11_ = ((_e360 - _e366) + _e370);
                }
                uint _e373 = v11_;
                v12_ = _e373;
                v13_ = (_e194 ? false : true);
            }
            uint _e376 = v12_;
            bool _e378 = v13_;
            uint _e380 = ((_e378 ? _e360 : _e376) * _e165);
            v14_ = 0u;
            if ((_e380 < _e147)) {
                uint _e383 = lightbvh_trails.list[_e380];
                v14_ = _e383;
            }
            uint _e385 = v14_;
            v16_ = 0u;
            v17_ = true;
            if ((_e165 == 2u)) {
                uint _e387 = (_e380 + 1u);
                bool _e388 = (_e387 < _e147);
                v15_ = 0u;
                if (_e388) {
                    uint _e390 = lightbvh_trails.list[_e387];
                    v15_ = _e390;
                }
                uint _e392 = v15_;
                v16_ = _e392;
                v17_ = (_e388 ? false : true);
            }
            uint _e395 = v16_;
            bool _e397 = v17_;
            uint _e398 = (_e397 ? 0u : _e395);
            v18_ = false;
            v19_ = LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u));
            if (_e363) {
                uint _e405 = (_e159 + _e362);
                v20_ = 4294967295u;
                if ((_e405 < _e147)) {
                    uint _e408 = lightbvh_trails.list[_e405];
                    v20_ = _e408;
                }
                uint _e410 = v20_;
                v23_ = 0u;
                v24_ = true;
                if ((_e410 != 4294967295u)) {
                    bool _e412 = (_e410 >= 2147483648u);
                    v22_ = 0u;
                    if (_e412) {
                        uint _e416 = (_e162 + ((_e410 - 2147483648u) + (_e385 & 7u)));
                        v21_ = 4294967295u;
                        if ((_e416 < _e147)) {
                            uint _e419 = lightbvh_trails.list[_e416];
                            v21_ = _e419;
                        }
                        uint _e421 = v21_;
                        v22_ = _e421;
                    }
                    uint _e423 = v22_;
                    v23_ = _e423;
                    v24_ = (_e412 ? false : true);
                }
                uint _e426 = v23_;
                bool _e428 = v24_;
                v25_ = 0u;
                v26_ = LightbvhType23_(0u, 0u);
                v27_ = (_e428 ? _e410 : _e426);
                bool loop_init = true;
                while(true) {
                    if (!loop_init) {
                        v25_ = v32_;
                        v26_ = v33_;
                        v27_ = v34_;
                        v36_ = false;
                        if (!(v35_)) {
                            break;
                        }
                    }
                    loop_init = false;
                    uint _e431 = v25_;
                    LightbvhType23_ _e433 = v26_;
                    uint _e435 = v27_;
                    v37_ = _e433;
                    v32_ = 0u;
                    v33_ = LightbvhType23_(0u, 0u);
                    v34_ = 0u;
                    v35_ = false;
                    if ((_e435 < 2147483648u)) {
                        bool _e437 = (_e431 < 20u);
                        v29_ = 0u;
                        v30_ = LightbvhType23_(0u, 0u);
                        v31_ = 0u;
                        if (_e437) {
                            uint _e456 = (_e156 + (_e435 >> 3u));
                            v28_ = 4294967295u;
                            if ((_e456 < _e147)) {
                                uint _e459 = lightbvh_trails.list[_e456];
                                v28_ = _e459;
                            }
                            uint _e461 = v28_;
                            v29_ = (_e431 + 1u);
                            v30_ = LightbvhType23_((((_e433.member << 3u) | ((_e435 & 7u) & 7u)) & 1073741823u), (((_e433.member_1 << 3u) | ((_e433.member >> 27u) & 7u)) & 1073741823u));
                            v31_ = _e461;
                        }
                        uint _e464 = v29_;
                        LightbvhType23_ _e466 = v30_;
                        uint _e468 = v31_;
                        v32_ = _e464;
                        v33_ = _e466;
                        v34_ = _e468;
                        v35_ = _e437;
                    }
                    uint _e470 = v32_;
                    LightbvhType23_ _e472 = v33_;
                    uint _e474 = v34_;
                    bool _e476 = v35_;
                    continue;
                }
                bool _e479 = v36_;
                if (_e479) {
                    break;
                }
                LightbvhType23_ _e482 = v37_;
                v18_ = _e479;
                v19_ = LightbvhType24_(_e482, LightbvhType23_(_e385, _e398));
            }
            bool _e400 = v18_;
            LightbvhType24_ _e402 = v19_;
            v38_ = _e400;
            v39_ = _e402;
            if (_e363) {
            } else {
                v38_ = false;
                v39_ = LightbvhType24_(LightbvhType23_(_e385, _e398), LightbvhType23_(0u, 0u));
            }
            bool _e485 = v38_;
            LightbvhType24_ _e487 = v39_;
            v40_ = _e485;
            v41_ = _e487;
            v42_ = _e362;
            v43_ = _e360;
        }
        bool _e489 = v40_;
        LightbvhType24_ _e491 = v41_;
        uint _e493 = v42_;
        uint _e495 = v43_;
        bool _e498 = (_e174 == 0u);
        LightbvhType26_ _e500 = LightbvhType26_(_e491, LightbvhType23_(_e176.member_1[0], _e176.member_1[1]), _e176.member, LightbvhType25_(0.0, 1.0), 0u, (_e153 + _e150), 4294967295u, 4294967295u, 0u, 4194304u, 0u, _e174, _e498, (_e495 != 4294967295u));
        uint _e503 = (uint(21) - uint(findMSB(4128767u)));
        uint _e505 = ((_e503 < 22u) ? _e503 : 22u);
        uint _e513 = (_e505 & 31u);
        LightbvhType26_ _e534 = LightbvhType26_(_e500.member, LightbvhType23_((((_e176.member_1[0] - 67108864u) << _e513) | ((_e176.member_1[1] >> uint(1)) >> ((31u - _e505) & 31u))), (_e176.member_1[1] << _e513)), _e500.member_2, _e500.member_3, _e500.member_4, _e500.member_5, _e500.member_6, _e500.member_7, _e500.member_8, _e500.member_9, _e500.member_10, _e500.member_11, _e500.member_12, _e500.member_13);
        LightbvhType26_ _e551 = LightbvhType26_(_e534.member, _e534.member_1, _e534.member_2, _e534.member_3, _e534.member_4, _e534.member_5, _e534.member_6, _e534.member_7, _e534.member_8, (4128768u << _e513), _e534.member_10, _e534.member_11, _e534.member_12, _e534.member_13);
        v44_ = _e489;
        v45_ = LightbvhType27_(_e495, _e493, LightbvhType26_(_e551.member, _e551.member_1, _e551.member_2, _e551.member_3, _e551.member_4, _e551.member_5, _e551.member_6, _e551.member_7, _e551.member_8, _e551.member_9, _e505, _e551.member_11, _e551.member_12, _e551.member_13));
        v46_ = _e498;
        bool loop_init_1 = true;
        while(true) {
            if (!loop_init_1) {
                v44_ = v69_;
                v45_ = v70_;
                v46_ = v71_;
                v72_ = v69_;
                if (!((v46_ ? false : true))) {
                    break;
                }
            }
            loop_init_1 = false;
            bool _e569 = v44_;
            LightbvhType27_ _e571 = v45_;
            bool _e573 = v46_;
            v73_ = _e571;
            v74_ = _e571;
            v75_ = _e571;
            v76_ = _e571;
            v79_ = _e571;
            v80_ = _e571;
            v69_ = _e569;
            v70_ = LightbvhType27_(0u, 0u, LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false));
            v71_ = false;
            if (_e573) {
            } else {
                bool _e576 = (_e571.member_2.member_5 < _e141);
                uint _e577 = (_e576 ? _e571.member_2.member_5 : 0u);
                if ((_e577 < _e141)) {
                } else {
                    v72_ = true;
                    break;
                }
                uint _e606 = lightbvh_nodes.list[_e577][0u][0u];
                uint _e611 = lightbvh_nodes.list[_e577][0u][1u];
                uint _e616 = lightbvh_nodes.list[_e577][0u][2u];
                uint _e621 = lightbvh_nodes.list[_e577][0u][3u];
                int _e624 = (int((_e621 & 255u)) - 127);
                float _e625 = (uintBitsToFloat(_e606) - _e571.member_2.member_2.member[0]);
                float _e626 = (uintBitsToFloat(_e611) - _e571.member_2.member_2.member[1]);
                float _e627 = (uintBitsToFloat(_e616) - _e571.member_2.member_2.member[2]);
                float _e630 = uintBitsToFloat((floatBitsToUint(_e625) & 2147483647u));
                float _e633 = uintBitsToFloat((floatBitsToUint(_e626) & 2147483647u));
                float _e636 = uintBitsToFloat((floatBitsToUint(_e627) & 2147483647u));
                float _e638 = ((_e630 > _e633) ? _e630 : _e633);
                int _e646 = (int(((floatBitsToUint(((_e638 > _e636) ? _e638 : _e636)) >> uint(23)) & 255u)) - 127);
                int _e648 = ((_e646 > _e624) ? _e646 : _e624);
                int _e649 = (_e624 - _e648);
                int _e651 = ((_e649 < -40) ? -40 : _e649);
                int _e652 = -(_e648);
                int _e654 = ((_e652 < -126) ? -126 : _e652);
                float _e661 = uintBitsToFloat((uint((((_e654 > 127) ? 127 : _e654) + 127)) << uint(23)));
                int _e666 = ((_e651 < -126) ? -126 : _e651);
                float _e673 = uintBitsToFloat((uint((((_e666 > 127) ? 127 : _e666) + 127)) << uint(23)));
                float _e681 = (_e673 * 4.656613e-10);
                float _e693 = (2.0 * 8.0);
                float _e694 = (uintBitsToFloat((floatBitsToUint(_e571.member_2.member_2.member_1[0]) & 2147483647u)) * _e693);
                float _e695 = (uintBitsToFloat((floatBitsToUint(_e571.member_2.member_2.member_1[1]) & 2147483647u)) * _e693);
                float _e696 = (uintBitsToFloat((floatBitsToUint(_e571.member_2.member_2.member_1[2]) & 2147483647u)) * _e693);
                v0_ = float[8](0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
                v47_ = LightbvhType23_(0u, 8u);
                bool loop_init_2 = true;
                while(true) {
                    if (!loop_init_2) {
                        v47_ = v50_;
                        v52_ = _e569;
                        if (!((int(v51_.member) != 0))) {
                            break;
                        }
                    }
                    loop_init_2 = false;
                    LightbvhType23_ _e703 = v47_;
                    bool _e706 = (_e703.member < _e703.member_1);
                    v48_ = LightbvhType23_(0u, 0u);
                    v49_ = LightbvhType23_(0u, 0u);
                    if (_e706) {
                        v48_ = LightbvhType23_((_e703.member + 1u), _e703.member_1);
                        v49_ = LightbvhType23_(1u, _e703.member);
                    }
                    LightbvhType23_ _e708 = v48_;
                    LightbvhType23_ _e710 = v49_;
                    v50_ = _e708;
                    v51_ = _e710;
                    if (_e706) {
                    } else {
                        v50_ = _e703;
                        v51_ = LightbvhType23_(0u, LightbvhType23_(0u, 0u).member_1);
                    }
                    LightbvhType23_ _e720 = v50_;
                    LightbvhType23_ _e722 = v51_;
                    bool _e726 = (int(_e722.member) != 0);
                    if (_e726) {
                        bool _e727 = (_e722.member_1 < 8u);
                        if (_e727) {
                        } else {
                            v52_ = true;
                            break;
                        }
                        uint _e731 = lightbvh_nodes.list[_e577][1u][_e722.member_1];
                        if (_e727) {
                        } else {
                            v52_ = true;
                            break;
                        }
                        uint _e735 = lightbvh_nodes.list[_e577][2u][_e722.member_1];
                        if (_e727) {
                        } else {
                            v52_ = true;
                            break;
                        }
                        uint _e739 = lightbvh_nodes.list[_e577][3u][_e722.member_1];
                        if (_e727) {
                        } else {
                            v52_ = true;
                            break;
                        }
                        uint _e743 = lightbvh_nodes.list[_e577][4u][_e722.member_1];
                        float _e759 = ((_e625 * _e661) + (float(int(_e731)) * _e681));
                        float _e760 = ((_e626 * _e661) + (float(int((_e731 << 15u))) * _e681));
                        float _e761 = ((_e627 * _e661) + (float(int(_e735)) * _e681));
                        float _e766 = uintBitsToFloat((((_e743 << 20u) & 267386880u) + (floatBitsToUint(_e673) + 4043309056u)));
                        float _e771 = (float(int((_e735 << 15u))) * 4.656613e-10);
                        float _e773 = float(int(_e739));
                        float _e777 = float(int((_e739 << 8u)));
                        float _e781 = float(int((_e739 << 16u)));
                        float _e785 = (float(int((_e739 & 255u))) * 0.003921569);
                        float _e802 = (_e766 * _e766);
                        float _e808 = ((((_e759 * _e759) + (_e760 * _e760)) + (_e761 * _e761)) + 8.881784e-16);
                        float _e812 = (_e808 + (1.25 * _e802));
                        float _e817 = uintBitsToFloat((1595932665u - (floatBitsToUint(_e812) >> uint(1))));
                        float _e822 = (_e817 * (0.70395225 * (2.3892446 - (_e812 * (_e817 * _e817)))));
                        float _e823 = (_e766 * _e822);
                        float _e828 = ((((_e571.member_2.member_2.member_1[0] * 4.656613e-10) * _e773) + ((_e571.member_2.member_2.member_1[1] * 4.656613e-10) * _e777)) + ((_e571.member_2.member_2.member_1[2] * 4.656613e-10) * _e781));
                        float _e833 = (0.03162278 + (_e823 * (1.0 + (_e771 * (_e828 * _e828)))));
                        float _e839 = (((((_e571.member_2.member_2.member_1[0] + _e571.member_2.member_2.member_1[0]) * _e759) + ((_e571.member_2.member_2.member_1[1] + _e571.member_2.member_2.member_1[1]) * _e760)) + ((_e571.member_2.member_2.member_1[2] + _e571.member_2.member_2.member_1[2]) * _e761)) * _e822);
                        float _e841 = (_e839 + ((((_e694 + _e695) + _e696) + ((((_e694 * 4.656613e-10) * float(int(_e743))) + ((_e695 * 4.656613e-10) * float(int((_e743 << 8u))))) + ((_e696 * 4.656613e-10) * float(int((_e743 << 16u)))))) * _e823));
                        float _e843 = ((_e841 > 0.0001) ? _e841 : 0.0001);
                        float _e849 = (uintBitsToFloat((floatBitsToUint(_e839) & 2147483647u)) + _e833);
                        float _e855 = (1.0 + _e771);
                        float _e861 = ((((_e773 * _e759) + (_e777 * _e760)) + (_e781 * _e761)) * (-2.0 * 4.656613e-10));
                        float _e864 = (_e766 * ((_e855 > _e785) ? _e855 : _e785));
                        float _e866 = (_e808 - (2.5 * _e802));
                        float _e868 = (0.25 * (_e861 * _e861));
                        float _e874 = ((((_e866 > _e868) ? _e866 : _e868) + 8.881784e-16) + (1.25 * (_e864 * _e864)));
                        float _e879 = uintBitsToFloat((1595932665u - (floatBitsToUint(_e874) >> uint(1))));
                        float _e884 = (_e879 * (0.70395225 * (2.3892446 - (_e874 * (_e879 * _e879)))));
                        float _e886 = ((_e766 * _e884) * _e855);
                        float _e890 = ((0.03162278 + _e886) + (_e785 * (0.5 - _e886)));
                        float _e891 = (_e861 * _e884);
                        float _e895 = (uintBitsToFloat((floatBitsToUint(_e891) & 2147483647u)) + _e890);
                        float _e904 = ((_e849 * _e895) * (_e808 + (0.5 * _e802)));
                        float _e907 = uintBitsToFloat((2129859015u - floatBitsToUint(_e904)));
                        if (_e727) {
                        } else {
                            v52_ = true;
                            break;
                        }
                        v0_[_e722.member_1] = ((uintBitsToFloat(((_e735 & 2047u) << 19u)) * (((((_e839 > 0.0) ? _e839 : 0.0) * _e849) + (_e833 * ((_e843 < _e833) ? _e843 : _e833))) * ((((_e891 > 0.0) ? _e891 : 0.0) * _e895) + (_e890 * _e890)))) * (_e907 * (2.0 - (_e904 * _e907))));
                    }
                    continue;
                }
                bool _e915 = v52_;
                v72_ = _e915;
                if (_e915) {
                    break;
                }
                float _e916[8] = v0_;
                bool _e938 = (_e571.member_2.member_8 < 20u);
                v53_ = 0u;
                if (_e938) {
                    bool _e961 = (_e571.member_2.member_8 < 10u);
                    v55_ = _e571.member_2.member_8;
                    if (_e961) {
                    } else {
                        v55_ = (_e571.member_2.member_8 - 10u);
                    }
                    uint _e964 = v55_;
                    v53_ = (((_e961 ? _e571.member_2.member.member.member : _e571.member_2.member.member.member_1) >> (((_e964 * 3u) & 31u) & 31u)) & 7u);
                }
                uint _e940 = v53_;
                v56_ = _e940;
                if (_e938) {
                } else {
                    uint _e945 = (_e571.member_2.member_8 - 20u);
                    bool _e946 = (_e945 < 10u);
                    v54_ = _e945;
                    if (_e946) {
                    } else {
                        v54_ = (_e571.member_2.member_8 - 30u);
                    }
                    uint _e949 = v54_;
                    v56_ = (((_e946 ? _e571.member_2.member.member_1.member : _e571.member_2.member.member_1.member_1) >> (((_e949 * 3u) & 31u) & 31u)) & 7u);
                }
                uint _e973 = v56_;
                uint _e978 = (0u - ((_e916[1] > 0.0) ? 1u : 0u));
                uint _e979 = (1u & _e978);
                uint _e983 = (0u - ((_e916[2] > 0.0) ? 1u : 0u));
                uint _e986 = (_e979 ^ ((2u ^ _e979) & _e983));
                uint _e990 = (0u - ((_e916[3] > 0.0) ? 1u : 0u));
                uint _e993 = (_e986 ^ ((3u ^ _e986) & _e990));
                uint _e997 = (0u - ((_e916[4] > 0.0) ? 1u : 0u));
                uint _e1000 = (_e993 ^ ((4u ^ _e993) & _e997));
                uint _e1004 = (0u - ((_e916[5] > 0.0) ? 1u : 0u));
                uint _e1007 = (_e1000 ^ ((5u ^ _e1000) & _e1004));
                uint _e1011 = (0u - ((_e916[6] > 0.0) ? 1u : 0u));
                uint _e1014 = (_e1007 ^ ((6u ^ _e1007) & _e1011));
                uint _e1018 = (0u - ((_e916[7] > 0.0) ? 1u : 0u));
                uint _e1021 = (_e1014 ^ ((7u ^ _e1014) & _e1018));
                float _e1024 = ((((0.0 + _e916[0]) + _e916[4]) + ((0.0 + _e916[2]) + _e916[6])) + (((0.0 + _e916[1]) + _e916[5]) + ((0.0 + _e916[3]) + _e916[7])));
                bool _e1025 = (_e1024 > 0.0);
                float _e1029 = (_e1025 ? _e1024 : 1.0);
                uint _e1030 = floatBitsToUint(_e1029);
                float _e1035 = uintBitsToFloat(((_e1030 & 2147483648u) | (2129859015u - (_e1030 & 2147483647u))));
                float _e1038 = (_e1035 * (2.0 - (_e1029 * _e1035)));
                float _e1042 = ((float(int(_e571.member_2.member_9)) * 0.9999695) * (_e1038 * (2.0 - (_e1029 * _e1038))));
                v57_ = 2147483647;
                if (_e571.member_2.member_13) {
                } else {
                    v57_ = int((_e571.member_2.member_1.member >> 10u));
                }
                int _e1045 = v57_;
                int _e1051 = int((floatBitsToUint(((_e916[0] * _e1042) + 8388608.0)) & 8388607u));
                int _e1058 = (((_e1051 > 1) ? _e1051 : 1) & int((0u - ((_e916[0] > 0.0) ? 1u : 0u))));
                uint _e1059 = uint(_e1058);
                uint _e1060 = (_e1059 & 4294967295u);
                int _e1062 = int((_e571.member_2.member_13 ? _e973 : _e1021));
                uint _e1066 = (0u - (((_e1058 <= _e1045) && (0 < _e1062)) ? 1u : 0u));
                uint _e1067 = (_e1059 & _e1066);
                int _e1073 = int((floatBitsToUint(((_e916[1] * _e1042) + 8388608.0)) & 8388607u));
                int _e1078 = (_e1058 + (((_e1073 > 1) ? _e1073 : 1) & int(_e978)));
                uint _e1079 = uint(_e1078);
                uint _e1082 = (_e1060 ^ ((_e1079 ^ _e1060) & _e1066));
                uint _e1087 = (0u - (((_e1078 <= _e1045) && (1 < _e1062)) ? 1u : 0u));
                uint _e1090 = (_e1067 ^ ((_e1079 ^ _e1067) & _e1087));
                int _e1097 = int((floatBitsToUint(((_e916[2] * _e1042) + 8388608.0)) & 8388607u));
                int _e1102 = (_e1078 + (((_e1097 > 1) ? _e1097 : 1) & int(_e983)));
                uint _e1103 = uint(_e1102);
                uint _e1106 = (_e1082 ^ ((_e1103 ^ _e1082) & _e1087));
                uint _e1111 = (0u - (((_e1102 <= _e1045) && (2 < _e1062)) ? 1u : 0u));
                uint _e1114 = (_e1090 ^ ((_e1103 ^ _e1090) & _e1111));
                int _e1121 = int((floatBitsToUint(((_e916[3] * _e1042) + 8388608.0)) & 8388607u));
                int _e1126 = (_e1102 + (((_e1121 > 1) ? _e1121 : 1) & int(_e990)));
                uint _e1127 = uint(_e1126);
                uint _e1130 = (_e1106 ^ ((_e1127 ^ _e1106) & _e1111));
                uint _e1135 = (0u - (((_e1126 <= _e1045) && (3 < _e1062)) ? 1u : 0u));
                uint _e1138 = (_e1114 ^ ((_e1127 ^ _e1114) & _e1135));
                int _e1145 = int((floatBitsToUint(((_e916[4] * _e1042) + 8388608.0)) & 8388607u));
                int _e1150 = (_e1126 + (((_e1145 > 1) ? _e1145 : 1) & int(_e997)));
                uint _e1151 = uint(_e1150);
                uint _e1154 = (_e1130 ^ ((_e1151 ^ _e1130) & _e1135));
                uint _e1159 = (0u - (((_e1150 <= _e1045) && (4 < _e1062)) ? 1u : 0u));
                uint _e1162 = (_e1138 ^ ((_e1151 ^ _e1138) & _e1159));
                int _e1169 = int((floatBitsToUint(((_e916[5] * _e1042) + 8388608.0)) & 8388607u));
                int _e1174 = (_e1150 + (((_e1169 > 1) ? _e1169 : 1) & int(_e1004)));
                uint _e1175 = uint(_e1174);
                uint _e1178 = (_e1154 ^ ((_e1175 ^ _e1154) & _e1159));
                uint _e1183 = (0u - (((_e1174 <= _e1045) && (5 < _e1062)) ? 1u : 0u));
                uint _e1186 = (_e1162 ^ ((_e1175 ^ _e1162) & _e1183));
                int _e1193 = int((floatBitsToUint(((_e916[6] * _e1042) + 8388608.0)) & 8388607u));
                int _e1198 = (_e1174 + (((_e1193 > 1) ? _e1193 : 1) & int(_e1011)));
                uint _e1199 = uint(_e1198);
                uint _e1202 = (_e1178 ^ ((_e1199 ^ _e1178) & _e1183));
                uint _e1207 = (0u - (((_e1198 <= _e1045) && (6 < _e1062)) ? 1u : 0u));
                uint _e1210 = (_e1186 ^ ((_e1199 ^ _e1186) & _e1207));
                int _e1217 = int((floatBitsToUint(((_e916[7] * _e1042) + 8388608.0)) & 8388607u));
                int _e1222 = (_e1198 + (((_e1217 > 1) ? _e1217 : 1) & int(_e1018)));
                uint _e1223 = uint(_e1222);
                uint _e1226 = (_e1202 ^ ((_e1223 ^ _e1202) & _e1207));
                uint _e1231 = (0u - (((_e1222 <= _e1045) && (7 < _e1062)) ? 1u : 0u));
                uint _e1234 = (_e1210 ^ ((_e1223 ^ _e1210) & _e1231));
                uint _e1237 = (_e571.member_2.member_13 ? _e973 : ((((((((_e1066 & 1u) + (_e1087 & 1u)) + (_e1111 & 1u)) + (_e1135 & 1u)) + (_e1159 & 1u)) + (_e1183 & 1u)) + (_e1207 & 1u)) + (_e1231 & 1u)));
                bool _e1242 = (_e1237 < 8u);
                bool _e1243 = ((_e1025 && (_e1226 > _e1234)) && _e1242);
                uint _e1244 = (_e1242 ? _e1237 : 0u);
                v58_ = 0u;
                if (_e1243) {
                    v58_ = (((_e1237 == _e1021) ? _e571.member_2.member_9 : _e1226) - _e1234);
                }
                uint _e1248 = v58_;
                bool _e1249 = (_e1244 < 8u);
                if (_e1249) {
                } else {
                    v72_ = true;
                    break;
                }
                uint _e1253 = lightbvh_nodes.list[_e577][1u][_e1244];
                uint _e1254 = (_e1253 & 3u);
                if (_e1249) {
                } else {
                    v72_ = true;
                    break;
                }
                uint _e1258 = lightbvh_nodes.list[_e577][5u][_e1244];
                bool _e1262 = ((_e576 && (_e1248 > 0u)) && (_e1248 <= _e571.member_2.member_9));
                uint _e1263 = (_e1262 ? _e1248 : 1u);
                uint _e1265 = ((_e1263 - 1u) & 4194303u);
                uint _e1271 = (((_e1265 == 0u) ? 32u : (uint(31) - uint(findMSB(_e1265)))) - 10u);
                uint _e1273 = ((_e1271 < 22u) ? _e1271 : 22u);
                uint _e1286 = (_e1273 & 31u);
                LightbvhType27_ _e1311 = LightbvhType27_(_e571.member, _e571.member_1, LightbvhType26_(_e571.member_2.member, LightbvhType23_((((_e571.member_2.member_1.member - ((_e1243 ? _e1234 : 0u) << 10u)) << _e1286) | ((_e571.member_2.member_1.member_1 >> uint(1)) >> ((31u - _e1273) & 31u))), (_e571.member_2.member_1.member_1 << _e1286)), _e571.member_2.member_2, _e571.member_2.member_3, _e571.member_2.member_4, _e571.member_2.member_5, _e571.member_2.member_6, _e571.member_2.member_7, _e571.member_2.member_8, _e571.member_2.member_9, _e571.member_2.member_10, _e571.member_2.member_11, _e571.member_2.member_12, _e571.member_2.member_13));
                LightbvhType27_ _e1332 = LightbvhType27_(_e1311.member, _e1311.member_1, LightbvhType26_(_e1311.member_2.member, _e1311.member_2.member_1, _e1311.member_2.member_2, _e1311.member_2.member_3, _e1311.member_2.member_4, _e1311.member_2.member_5, _e1311.member_2.member_6, _e1311.member_2.member_7, _e1311.member_2.member_8, (_e1263 << _e1286), _e1311.member_2.member_10, _e1311.member_2.member_11, _e1311.member_2.member_12, _e1311.member_2.member_13));
                LightbvhType27_ _e1354 = LightbvhType27_(_e1332.member, _e1332.member_1, LightbvhType26_(_e1332.member_2.member, _e1332.member_2.member_1, _e1332.member_2.member_2, _e1332.member_2.member_3, _e1332.member_2.member_4, _e1332.member_2.member_5, _e1332.member_2.member_6, _e1332.member_2.member_7, _e1332.member_2.member_8, _e1332.member_2.member_9, (_e571.member_2.member_10 + _e1273), _e1332.member_2.member_11, _e1332.member_2.member_12, _e1332.member_2.member_13));
                uint _e1355 = (_e571.member_2.member_8 + 1u);
                v59_ = true;
                if ((_e1355 == 20u)) {
                } else {
                    v59_ = (_e1355 == 40u);
                }
                bool _e1359 = v59_;
                uint _e1360 = (_e1258 & 134217727u);
                uint _e1364 = (_e1258 >> (uint(findLSB(134217728u)) & 31u));
                bool _e1368 = (_e1360 < _e144);
                bool _e1369 = (((_e1262 && (_e1254 == 3u)) && _e938) && _e1368);
                bool _e1373 = ((_e1262 && (_e1254 == 1u)) && !(_e1359));
                LightbvhType27_ _e1395 = LightbvhType27_(_e1354.member, _e1354.member_1, LightbvhType26_(_e1354.member_2.member, _e1354.member_2.member_1, _e1354.member_2.member_2, _e1354.member_2.member_3, _e1354.member_2.member_4, _e1354.member_2.member_5, ((_e1262 && (_e1254 == 2u)) ? _e1258 : 4294967295u), _e1354.member_2.member_7, _e1354.member_2.member_8, _e1354.member_2.member_9, _e1354.member_2.member_10, _e1354.member_2.member_11, _e1354.member_2.member_12, _e1354.member_2.member_13));
                uint _e1398 = (_e571.member_2.member_11 - 1u);
                LightbvhType27_ _e1417 = LightbvhType27_(_e1395.member, _e1395.member_1, LightbvhType26_(_e1395.member_2.member, _e1395.member_2.member_1, _e1395.member_2.member_2, _e1395.member_2.member_3, _e1395.member_2.member_4, _e1395.member_2.member_5, _e1395.member_2.member_6, _e1395.member_2.member_7, _e1395.member_2.member_8, _e1395.member_2.member_9, _e1395.member_2.member_10, _e1398, _e1395.member_2.member_12, _e1395.member_2.member_13));
                bool _e1421 = (!((_e1369 || _e1373)) || (_e1398 == 0u));
                LightbvhType27_ _e1440 = LightbvhType27_(_e1417.member, _e1417.member_1, LightbvhType26_(_e1417.member_2.member, _e1417.member_2.member_1, _e1417.member_2.member_2, _e1417.member_2.member_3, _e1417.member_2.member_4, _e1417.member_2.member_5, _e1417.member_2.member_6, _e1417.member_2.member_7, _e1417.member_2.member_8, _e1417.member_2.member_9, _e1417.member_2.member_10, _e1417.member_2.member_11, _e1421, _e1417.member_2.member_13));
                v60_ = LightbvhType27_(0u, 0u, LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false));
                if (_e1369) {
                    if (_e1368) {
                    } else {
                        v72_ = true;
                        break;
                    }
                    LightbvhType27_ _e1505 = LightbvhType27_(_e1440.member, _e1440.member_1, LightbvhType26_(_e1440.member_2.member, _e1440.member_2.member_1, _e1440.member_2.member_2, _e1440.member_2.member_3, _e1440.member_2.member_4, _e1440.member_2.member_5, _e1440.member_2.member_6, _e1360, _e1440.member_2.member_8, _e1440.member_2.member_9, _e1440.member_2.member_10, _e1440.member_2.member_11, _e1440.member_2.member_12, _e1440.member_2.member_13));
                    uint _e1508 = lightbvh_instances.list[_e1360].root;
                    LightbvhType27_ _e1527 = LightbvhType27_(_e1505.member, _e1505.member_1, LightbvhType26_(_e1505.member_2.member, _e1505.member_2.member_1, _e1505.member_2.member_2, _e1505.member_2.member_3, _e1505.member_2.member_4, _e1508, _e1505.member_2.member_6, _e1505.member_2.member_7, _e1505.member_2.member_8, _e1505.member_2.member_9, _e1505.member_2.member_10, _e1505.member_2.member_11, _e1505.member_2.member_12, _e1505.member_2.member_13));
                    bool _e1528 = (_e1508 == 4294967295u);
                    v62_ = 4294967295u;
                    if (_e1528) {
                        uint _e1531 = lightbvh_instances.list[_e1360].first_light;
                        v62_ = _e1531;
                    }
                    uint _e1533 = v62_;
                    LightbvhType27_ _e1552 = LightbvhType27_(_e1527.member, _e1527.member_1, LightbvhType26_(_e1527.member_2.member, _e1527.member_2.member_1, _e1527.member_2.member_2, _e1527.member_2.member_3, _e1527.member_2.member_4, _e1527.member_2.member_5, _e1533, _e1527.member_2.member_7, _e1527.member_2.member_8, _e1527.member_2.member_9, _e1527.member_2.member_10, _e1527.member_2.member_11, _e1527.member_2.member_12, _e1527.member_2.member_13));
                    bool _e1553 = (_e1421 || _e1528);
                    LightbvhType27_ _e1572 = LightbvhType27_(_e1552.member, _e1552.member_1, LightbvhType26_(_e1552.member_2.member, _e1552.member_2.member_1, _e1552.member_2.member_2, _e1552.member_2.member_3, _e1552.member_2.member_4, _e1552.member_2.member_5, _e1552.member_2.member_6, _e1552.member_2.member_7, _e1552.member_2.member_8, _e1552.member_2.member_9, _e1552.member_2.member_10, _e1552.member_2.member_11, _e1553, _e1552.member_2.member_13));
                    LightbvhType27_ _e1591 = LightbvhType27_(_e1572.member, _e1572.member_1, LightbvhType26_(_e1572.member_2.member, _e1572.member_2.member_1, _e1572.member_2.member_2, _e1572.member_2.member_3, _e1572.member_2.member_4, _e1572.member_2.member_5, _e1572.member_2.member_6, _e1572.member_2.member_7, 20u, _e1572.member_2.member_9, _e1572.member_2.member_10, _e1572.member_2.member_11, _e1572.member_2.member_12, _e1572.member_2.member_13));
                    v63_ = _e1591;
                    if ((_e1364 > 0u)) {
                        uint _e1594 = ((_e1508 < _e141) ? _e1508 : 0u);
                        if ((_e1594 < _e141)) {
                        } else {
                            v72_ = true;
                            break;
                        }
                        uint _e1597 = ((_e1364 - 1u) % 8u);
                        bool _e1598 = (_e1597 < 8u);
                        if (_e1598) {
                        } else {
                            v72_ = true;
                            break;
                        }
                        uint _e1602 = lightbvh_nodes.list[_e1594][1u][_e1597];
                        uint _e1603 = (_e1602 & 3u);
                        if (_e1598) {
                        } else {
                            v72_ = true;
                            break;
                        }
                        uint _e1607 = lightbvh_nodes.list[_e1594][5u][_e1597];
                        LightbvhType27_ _e1626 = LightbvhType27_(_e1591.member, _e1591.member_1, LightbvhType26_(_e1591.member_2.member, _e1591.member_2.member_1, _e1591.member_2.member_2, _e1591.member_2.member_3, _e1591.member_2.member_4, _e1607, _e1591.member_2.member_6, _e1591.member_2.member_7, _e1591.member_2.member_8, _e1591.member_2.member_9, _e1591.member_2.member_10, _e1591.member_2.member_11, _e1591.member_2.member_12, _e1591.member_2.member_13));
                        LightbvhType27_ _e1647 = LightbvhType27_(_e1626.member, _e1626.member_1, LightbvhType26_(_e1626.member_2.member, _e1626.member_2.member_1, _e1626.member_2.member_2, _e1626.member_2.member_3, _e1626.member_2.member_4, _e1626.member_2.member_5, ((_e1603 == 2u) ? _e1607 : 4294967295u), _e1626.member_2.member_7, _e1626.member_2.member_8, _e1626.member_2.member_9, _e1626.member_2.member_10, _e1626.member_2.member_11, _e1626.member_2.member_12, _e1626.member_2.member_13));
                        LightbvhType27_ _e1668 = LightbvhType27_(_e1647.member, _e1647.member_1, LightbvhType26_(_e1647.member_2.member, _e1647.member_2.member_1, _e1647.member_2.member_2, _e1647.member_2.member_3, _e1647.member_2.member_4, _e1647.member_2.member_5, _e1647.member_2.member_6, _e1647.member_2.member_7, _e1647.member_2.member_8, _e1647.member_2.member_9, _e1647.member_2.member_10, _e1647.member_2.member_11, (_e1553 || (_e1603 != 1u)), _e1647.member_2.member_13));
                        v63_ = LightbvhType27_(_e1668.member, _e1668.member_1, LightbvhType26_(_e1668.member_2.member, _e1668.member_2.member_1, _e1668.member_2.member_2, _e1668.member_2.member_3, _e1668.member_2.member_4, _e1668.member_2.member_5, _e1668.member_2.member_6, _e1668.member_2.member_7, 21u, _e1668.member_2.member_9, _e1668.member_2.member_10, _e1668.member_2.member_11, _e1668.member_2.member_12, _e1668.member_2.member_13));
                    }
                    LightbvhType27_ _e1689 = v63_;
                    float _e1699 = lightbvh_instances.list[_e1360].translation[0u];
                    float _e1703 = lightbvh_instances.list[_e1360].translation[1u];
                    float _e1707 = lightbvh_instances.list[_e1360].translation[2u];
                    float _e1708 = (_e176.member.member[0] - _e1699);
                    float _e1709 = (_e176.member.member[1] - _e1703);
                    float _e1710 = (_e176.member.member[2] - _e1707);
                    float _e1715 = ((uintBitsToFloat((floatBitsToUint(_e1708) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1708);
                    float _e1720 = ((uintBitsToFloat((floatBitsToUint(_e1709) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1709);
                    float _e1725 = ((uintBitsToFloat((floatBitsToUint(_e1710) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1710);
                    float _e1730 = lightbvh_instances.list[_e1360].inverse_[0u][0u];
                    float _e1735 = lightbvh_instances.list[_e1360].inverse_[0u][1u];
                    float _e1740 = lightbvh_instances.list[_e1360].inverse_[0u][2u];
                    float _e1748 = lightbvh_instances.list[_e1360].inverse_[1u][0u];
                    float _e1753 = lightbvh_instances.list[_e1360].inverse_[1u][1u];
                    float _e1758 = lightbvh_instances.list[_e1360].inverse_[1u][2u];
                    float _e1769 = lightbvh_instances.list[_e1360].inverse_[2u][0u];
                    float _e1774 = lightbvh_instances.list[_e1360].inverse_[2u][1u];
                    float _e1779 = lightbvh_instances.list[_e1360].inverse_[2u][2u];
                    float _e1783 = (((_e1730 * _e1715) + (_e1748 * _e1720)) + (_e1769 * _e1725));
                    float _e1784 = (((_e1735 * _e1715) + (_e1753 * _e1720)) + (_e1774 * _e1725));
                    float _e1785 = (((_e1740 * _e1715) + (_e1758 * _e1720)) + (_e1779 * _e1725));
                    float _e1796 = lightbvh_instances.list[_e1360].columns[0u][0u];
                    float _e1801 = lightbvh_instances.list[_e1360].columns[0u][1u];
                    float _e1806 = lightbvh_instances.list[_e1360].columns[0u][2u];
                    float _e1811 = (((_e1796 * _e176.member.member_1[0]) + (_e1801 * _e176.member.member_1[1])) + (_e1806 * _e176.member.member_1[2]));
                    float _e1816 = lightbvh_instances.list[_e1360].columns[1u][0u];
                    float _e1821 = lightbvh_instances.list[_e1360].columns[1u][1u];
                    float _e1826 = lightbvh_instances.list[_e1360].columns[1u][2u];
                    float _e1831 = (((_e1816 * _e176.member.member_1[0]) + (_e1821 * _e176.member.member_1[1])) + (_e1826 * _e176.member.member_1[2]));
                    float _e1836 = lightbvh_instances.list[_e1360].columns[2u][0u];
                    float _e1841 = lightbvh_instances.list[_e1360].columns[2u][1u];
                    float _e1846 = lightbvh_instances.list[_e1360].columns[2u][2u];
                    float _e1851 = (((_e1836 * _e176.member.member_1[0]) + (_e1841 * _e176.member.member_1[1])) + (_e1846 * _e176.member.member_1[2]));
                    float _e1856 = ((uintBitsToFloat((floatBitsToUint(_e1811) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1811);
                    float _e1861 = ((uintBitsToFloat((floatBitsToUint(_e1831) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1831);
                    float _e1866 = ((uintBitsToFloat((floatBitsToUint(_e1851) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1851);
                    float _e1871 = (((_e1856 * _e1856) + (_e1861 * _e1861)) + (_e1866 * _e1866));
                    v64_ = 0.0;
                    if ((_e1871 >= uintBitsToFloat(67108864u))) {
                        float _e1878 = uintBitsToFloat((1597463007u - (floatBitsToUint(_e1871) >> uint(1))));
                        float _e1879 = (0.5 * _e1871);
                        float _e1883 = (_e1878 * (1.5 - ((_e1879 * _e1878) * _e1878)));
                        v64_ = (_e1883 * (1.5 - ((_e1879 * _e1883) * _e1883)));
                    }
                    float _e1889 = v64_;
                    float _e1890 = -(1.1529215e18);
                    v65_ = _e1890;
                    if ((_e1783 < _e1890)) {
                    } else {
                        v65_ = ((_e1783 > 1.1529215e18) ? 1.1529215e18 : _e1783);
                    }
                    float _e1895 = v65_;
                    v66_ = _e1890;
                    if ((_e1784 < _e1890)) {
                    } else {
                        v66_ = ((_e1784 > 1.1529215e18) ? 1.1529215e18 : _e1784);
                    }
                    float _e1905 = v66_;
                    v67_ = _e1890;
                    if ((_e1785 < _e1890)) {
                    } else {
                        v67_ = ((_e1785 > 1.1529215e18) ? 1.1529215e18 : _e1785);
                    }
                    float _e1915 = v67_;
                    float _e1922 = (_e1856 * _e1889);
                    float _e1928 = (_e1861 * _e1889);
                    float _e1934 = (_e1866 * _e1889);
                    v60_ = LightbvhType27_(_e1689.member, _e1689.member_1, LightbvhType26_(_e1689.member_2.member, _e1689.member_2.member_1, LightbvhType14_(float[3](((uintBitsToFloat((floatBitsToUint(_e1895) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1895), ((uintBitsToFloat((floatBitsToUint(_e1905) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1905), ((uintBitsToFloat((floatBitsToUint(_e1915) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1915)), float[3](((uintBitsToFloat((floatBitsToUint(_e1922) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1922), ((uintBitsToFloat((floatBitsToUint(_e1928) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1928), ((uintBitsToFloat((floatBitsToUint(_e1934) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1934))), _e1689.member_2.member_3, _e1689.member_2.member_4, _e1689.member_2.member_5, _e1689.member_2.member_6, _e1689.member_2.member_7, _e1689.member_2.member_8, _e1689.member_2.member_9, _e1689.member_2.member_10, _e1689.member_2.member_11, _e1689.member_2.member_12, _e1689.member_2.member_13));
                }
                LightbvhType27_ _e1442 = v60_;
                v68_ = _e1442;
                if (_e1369) {
                } else {
                    v61_ = _e571.member_2.member_5;
                    if (_e1373) {
                        v61_ = (_e1258 + (_e938 ? _e150 : 0u));
                    }
                    uint _e1446 = v61_;
                    LightbvhType27_ _e1465 = LightbvhType27_(_e1440.member, _e1440.member_1, LightbvhType26_(_e1440.member_2.member, _e1440.member_2.member_1, _e1440.member_2.member_2, _e1440.member_2.member_3, _e1440.member_2.member_4, _e1446, _e1440.member_2.member_6, _e1440.member_2.member_7, _e1440.member_2.member_8, _e1440.member_2.member_9, _e1440.member_2.member_10, _e1440.member_2.member_11, _e1440.member_2.member_12, _e1440.member_2.member_13));
                    v68_ = LightbvhType27_(_e1465.member, _e1465.member_1, LightbvhType26_(_e1465.member_2.member, _e1465.member_2.member_1, _e1465.member_2.member_2, _e1465.member_2.member_3, _e1465.member_2.member_4, _e1465.member_2.member_5, _e1465.member_2.member_6, _e1465.member_2.member_7, (_e571.member_2.member_8 + (_e1373 ? 1u : 0u)), _e1465.member_2.member_9, _e1465.member_2.member_10, _e1465.member_2.member_11, _e1465.member_2.member_12, _e1465.member_2.member_13));
                }
                LightbvhType27_ _e1962 = v68_;
                v69_ = _e915;
                v70_ = _e1962;
                v71_ = _e1962.member_2.member_12;
            }
            bool _e1966 = v69_;
            LightbvhType27_ _e1968 = v70_;
            bool _e1970 = v71_;
            continue;
        }
        bool _e1974 = v72_;
        if (_e1974) {
            break;
        }
        LightbvhType27_ _e1976 = v73_;
        bool _e1978 = (_e1976.member != 4294967295u);
        LightbvhType27_ _e1980 = v74_;
        LightbvhType27_ _e1986 = v75_;
        LightbvhType27_ _e1990 = v76_;
        bool _e1994 = ((_e1980.member_2.member_6 != 4294967295u) && (!(_e1978) || (_e1986.member_2.member_7 == _e1990.member_1)));
        uint _e1995 = (_e1978 ? _e1990.member_1 : _e1986.member_2.member_7);
        v78_ = _e1976.member;
        if (_e1978) {
        } else {
            v77_ = _e1980.member_2.member_6;
            if ((_e1986.member_2.member_7 < _e144)) {
                uint _e1999 = lightbvh_instances.list[_e1986.member_2.member_7].first_light;
                uint _e2003 = lightbvh_instances.list[_e1986.member_2.member_7].first;
                v77_ = ((_e1980.member_2.member_6 - _e1999) + _e2003);
            }
            uint _e2006 = v77_;
            v78_ = _e2006;
        }
        uint _e2008 = v78_;
        v81_ = 0.0;
        if (_e1994) {
            LightbvhType27_ _e2010 = v79_;
            LightbvhType27_ _e2016 = v80_;
            int _e2023 = -(int((22u + ((_e2010.member_2.member_10 < 98u) ? _e2010.member_2.member_10 : 98u))));
            int _e2025 = ((_e2023 < -126) ? -126 : _e2023);
            v81_ = (float(int(_e2016.member_2.member_9)) * uintBitsToFloat((uint((((_e2025 > 127) ? 127 : _e2025) + 127)) << uint(23))));
        }
        float _e2035 = v81_;
        v83_ = 0u;
        v84_ = true;
        if ((_e168 > 0u)) {
            bool _e2037 = (_e1995 < _e144);
            v82_ = 0u;
            if (_e2037) {
                uint _e2040 = lightbvh_instances.list[_e1995].count;
                v82_ = _e2040;
            }
            uint _e2042 = v82_;
            v83_ = _e2042;
            v84_ = (_e2037 ? false : true);
        }
        uint _e2045 = v83_;
        bool _e2047 = v84_;
        uint _e2052 = ((_e2047 ? _e171 : _e2045) & 2147483647u);
        uint _e2057 = floatBitsToUint((float(65536) * uintBitsToFloat(880803840u)));
        uint _e2058 = floatBitsToUint(float(int(((_e2052 > 0u) ? _e2052 : 1u))));
        uint _e2063 = ((_e2057 >> uint(23)) & 255u);
        uint _e2067 = (_e2057 & 8388607u);
        uint _e2068 = (_e2067 | 8388608u);
        uint _e2069 = (_e2058 & 8388607u);
        uint _e2070 = (_e2069 | 8388608u);
        bool _e2071 = (_e2068 < _e2070);
        float _e2075 = uintBitsToFloat((_e2069 | 1065353216u));
        uint _e2076 = floatBitsToUint(_e2075);
        float _e2081 = uintBitsToFloat(((_e2076 & 2147483648u) | (2129859015u - (_e2076 & 2147483647u))));
        float _e2084 = (_e2081 * (2.0 - (_e2075 * _e2081)));
        float _e2087 = (_e2084 * (2.0 - (_e2075 * _e2084)));
        float _e2091 = ((uintBitsToFloat((_e2067 | 1065353216u)) * _e2087) * (_e2071 ? 16777216.0 : 8388608.0));
        float _e2092 = uintBitsToFloat(0u);
        float _e2093 = uintBitsToFloat(1333788671u);
        uint _e2098 = ((_e2091 > _e2093) ? 4294967295u : ((_e2091 < _e2092) ? 0u : uint(_e2091)));
        int _e2104 = int(((_e2068 << uint(((_e2071 ? 24 : 23) & 31))) - (_e2098 * _e2070)));
        float _e2109 = ((float((_e2104 >> uint(8))) * _e2087) * 3.0517578e-5);
        float _e2110 = uintBitsToFloat(3472883712u);
        float _e2111 = uintBitsToFloat(1325400063u);
        int _e2118 = ((_e2109 == _e2109) ? ((_e2109 > _e2111) ? 2147483647 : ((_e2109 < _e2110) ? -2147483648 : int(_e2109))) : 0);
        uint _e2120 = (_e2098 + uint(_e2118));
        int _e2121 = int(_e2070);
        int _e2123 = (_e2104 - (_e2118 * _e2121));
        bool _e2124 = (_e2123 < 0);
        v85_ = _e2120;
        if (_e2124) {
            v85_ = (_e2120 - 1u);
        }
        uint _e2127 = v85_;
        v86_ = _e2123;
        if (_e2124) {
            v86_ = (_e2123 + _e2121);
        }
        int _e2130 = v86_;
        bool _e2131 = (_e2130 >= _e2121);
        v87_ = _e2127;
        if (_e2131) {
            v87_ = (_e2127 + 1u);
        }
        uint _e2134 = v87_;
        v88_ = _e2130;
        if (_e2131) {
            v88_ = (_e2130 - _e2121);
        }
        int _e2137 = v88_;
        v89_ = _e2134;
        if (((_e2137 * 2) > _e2121)) {
            v89_ = (_e2134 + 1u);
        }
        uint _e2142 = v89_;
        int _e2147 = ((int(_e2063) - int(((_e2058 >> uint(23)) & 255u))) + (_e2071 ? 126 : 127));
        v92_ = 0u;
        v93_ = true;
        if ((_e2063 == 0u)) {
        } else {
            bool _e2149 = (_e2147 <= 0);
            v91_ = 0u;
            if (_e2149) {
            } else {
                v90_ = 2139095040u;
                if ((_e2147 >= 255)) {
                } else {
                    v90_ = ((uint(_e2147) << uint(23)) + (_e2142 & 8388607u));
                }
                uint _e2157 = v90_;
                v91_ = _e2157;
            }
            uint _e2159 = v91_;
            v92_ = _e2159;
            v93_ = _e2149;
        }
        uint _e2161 = v92_;
        bool _e2163 = v93_;
        uint _e2167 = (_e168 & 2147483647u);
        uint _e2172 = floatBitsToUint(uintBitsToFloat((((_e2057 ^ _e2058) & 2147483648u) | (_e2163 ? 0u : _e2161))));
        uint _e2173 = floatBitsToUint(float(int(((_e2167 > 0u) ? _e2167 : 1u))));
        uint _e2178 = ((_e2172 >> uint(23)) & 255u);
        uint _e2182 = (_e2172 & 8388607u);
        uint _e2183 = (_e2182 | 8388608u);
        uint _e2184 = (_e2173 & 8388607u);
        uint _e2185 = (_e2184 | 8388608u);
        bool _e2186 = (_e2183 < _e2185);
        float _e2190 = uintBitsToFloat((_e2184 | 1065353216u));
        uint _e2191 = floatBitsToUint(_e2190);
        float _e2196 = uintBitsToFloat(((_e2191 & 2147483648u) | (2129859015u - (_e2191 & 2147483647u))));
        float _e2199 = (_e2196 * (2.0 - (_e2190 * _e2196)));
        float _e2202 = (_e2199 * (2.0 - (_e2190 * _e2199)));
        float _e2206 = ((uintBitsToFloat((_e2182 | 1065353216u)) * _e2202) * (_e2186 ? 16777216.0 : 8388608.0));
        uint _e2211 = ((_e2206 > _e2093) ? 4294967295u : ((_e2206 < _e2092) ? 0u : uint(_e2206)));
        int _e2217 = int(((_e2183 << uint(((_e2186 ? 24 : 23) & 31))) - (_e2211 * _e2185)));
        float _e2222 = ((float((_e2217 >> uint(8))) * _e2202) * 3.0517578e-5);
        int _e2229 = ((_e2222 == _e2222) ? ((_e2222 > _e2111) ? 2147483647 : ((_e2222 < _e2110) ? -2147483648 : int(_e2222))) : 0);
        uint _e2231 = (_e2211 + uint(_e2229));
        int _e2232 = int(_e2185);
        int _e2234 = (_e2217 - (_e2229 * _e2232));
        bool _e2235 = (_e2234 < 0);
        v94_ = _e2231;
        if (_e2235) {
            v94_ = (_e2231 - 1u);
        }
        uint _e2238 = v94_;
        v95_ = _e2234;
        if (_e2235) {
            v95_ = (_e2234 + _e2232);
        }
        int _e2241 = v95_;
        bool _e2242 = (_e2241 >= _e2232);
        v96_ = _e2238;
        if (_e2242) {
            v96_ = (_e2238 + 1u);
        }
        uint _e2245 = v96_;
        v97_ = _e2241;
        if (_e2242) {
            v97_ = (_e2241 - _e2232);
        }
        int _e2248 = v97_;
        v98_ = _e2245;
        if (((_e2248 * 2) > _e2232)) {
            v98_ = (_e2245 + 1u);
        }
        uint _e2253 = v98_;
        int _e2258 = ((int(_e2178) - int(((_e2173 >> uint(23)) & 255u))) + (_e2186 ? 126 : 127));
        v101_ = 0u;
        v102_ = true;
        if ((_e2178 == 0u)) {
        } else {
            bool _e2260 = (_e2258 <= 0);
            v100_ = 0u;
            if (_e2260) {
            } else {
                v99_ = 2139095040u;
                if ((_e2258 >= 255)) {
                } else {
                    v99_ = ((uint(_e2258) << uint(23)) + (_e2253 & 8388607u));
                }
                uint _e2268 = v99_;
                v100_ = _e2268;
            }
            uint _e2270 = v100_;
            v101_ = _e2270;
            v102_ = _e2260;
        }
        uint _e2272 = v101_;
        bool _e2274 = v102_;
        v103_ = LightbvhType19_(4294967295u, 4294967295u, 0.0);
        if ((_e1978 || _e1994)) {
            v103_ = LightbvhType19_(_e2008, _e1995, (_e2035 + uintBitsToFloat((((_e2172 ^ _e2173) & 2147483648u) | (_e2274 ? 0u : _e2272)))));
        }
        LightbvhType19_ _e2282 = v103_;
        results = _e2282;
        break;
    } while(false);
    LightbvhType19_ _e2388 = results;
    return LightbvhLightSample(_e2388.member, _e2388.member_1, _e2388.member_2);
}

float lightbvh_pmf(vec3 p_1, vec3 n_1, uint light, uint instance) {
    LightbvhType16_ queries_1 = LightbvhType16_(LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), uint[2](0u, 0u));
    float results_1 = 0.0;
    float v0_1[8] = float[8](0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    uint v1_1 = 0u;
    uint v2_1 = 0u;
    bool v3_1 = false;
    uint v4_1 = 0u;
    uint v5_1 = 0u;
    uint v6_1 = 0u;
    bool v7_1 = false;
    bool v8_1 = false;
    LightbvhType24_ v9_1 = LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u));
    uint v10_1 = 0u;
    uint v11_1 = 0u;
    uint v12_1 = 0u;
    uint v13_1 = 0u;
    bool v14_1 = false;
    uint v15_1 = 0u;
    LightbvhType23_ v16_1 = LightbvhType23_(0u, 0u);
    uint v17_1 = 0u;
    uint v18_1 = 0u;
    uint v19_1 = 0u;
    LightbvhType23_ v20_1 = LightbvhType23_(0u, 0u);
    uint v21_1 = 0u;
    uint v22_1 = 0u;
    LightbvhType23_ v23_1 = LightbvhType23_(0u, 0u);
    uint v24_1 = 0u;
    bool v25_1 = false;
    bool v26_1 = false;
    LightbvhType23_ v27_1 = LightbvhType23_(0u, 0u);
    bool v28_1 = false;
    LightbvhType24_ v29_1 = LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u));
    bool v30_1 = false;
    LightbvhType26_ v31_1 = LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false);
    bool v32_1 = false;
    LightbvhType23_ v33_1 = LightbvhType23_(0u, 0u);
    LightbvhType23_ v34_1 = LightbvhType23_(0u, 0u);
    LightbvhType23_ v35_1 = LightbvhType23_(0u, 0u);
    LightbvhType23_ v36_1 = LightbvhType23_(0u, 0u);
    LightbvhType23_ v37_1 = LightbvhType23_(0u, 0u);
    bool v38_1 = false;
    uint v39_1 = 0u;
    uint v40_1 = 0u;
    uint v41_1 = 0u;
    uint v42_1 = 0u;
    int v43_1 = 0;
    uint v44_1 = 0u;
    bool v45_1 = false;
    LightbvhType26_ v46_1 = LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false);
    uint v47_1 = 0u;
    uint v48_1 = 0u;
    LightbvhType26_ v49_1 = LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false);
    float v50_1 = 0.0;
    float v51_1 = 0.0;
    float v52_1 = 0.0;
    float v53_1 = 0.0;
    LightbvhType26_ v54_1 = LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false);
    bool v55_1 = false;
    LightbvhType26_ v56_1 = LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false);
    bool v57_1 = false;
    bool v58_1 = false;
    LightbvhType26_ v59_1 = LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false);
    LightbvhType26_ v60_1 = LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false);
    LightbvhType26_ v61_1 = LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false);
    LightbvhType26_ v62_1 = LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false);
    float v63_1 = 0.0;
    uint v64_1 = 0u;
    uint v65_1 = 0u;
    bool v66_1 = false;
    uint v67_1 = 0u;
    int v68_1 = 0;
    uint v69_1 = 0u;
    int v70_1 = 0;
    uint v71_1 = 0u;
    uint v72_1 = 0u;
    uint v73_1 = 0u;
    uint v74_1 = 0u;
    bool v75_1 = false;
    uint v76_1 = 0u;
    int v77_1 = 0;
    uint v78_1 = 0u;
    int v79_1 = 0;
    uint v80_1 = 0u;
    uint v81_1 = 0u;
    uint v82_1 = 0u;
    uint v83_1 = 0u;
    bool v84_1 = false;
    bool v85_1 = false;
    bool v86_1 = false;
    bool v87_1 = false;
    float v88_1 = 0.0;
    queries_1 = LightbvhType16_(LightbvhType14_(float[3](p_1.x, p_1.y, p_1.z), float[3](n_1.x, n_1.y, n_1.z)), uint[2](light, instance));
    do {
        uint _e135 = uint(lightbvh_nodes.list.length());
        uint _e138 = uint(lightbvh_instances.list.length());
        uint _e141 = uint(lightbvh_trails.list.length());
        uint _e144 = lightbvh_tree.top;
        uint _e147 = lightbvh_tree.root;
        uint _e150 = lightbvh_tree.above;
        uint _e153 = lightbvh_tree.places;
        uint _e156 = lightbvh_tree.parts;
        uint _e159 = lightbvh_tree.trail_words;
        uint _e162 = lightbvh_tree.live;
        uint _e165 = lightbvh_tree.lights;
        uint _e168 = lightbvh_tree.depth;
        LightbvhType16_ _e170 = queries_1;
        bool _e176 = (_e162 > 0u);
        uint _e177 = (_e176 ? _e170.member_1[1] : 4294967295u);
        bool _e178 = (_e177 < _e138);
        v2_1 = 0u;
        v3_1 = true;
        if (_e178) {
            v1_1 = 0u;
            if (_e176) {
                uint _e181 = lightbvh_instances.list[_e177].first;
                uint _e185 = lightbvh_instances.list[_e177].first_light;
                v1_1 = ((_e170.member_1[0] - _e181) + _e185);
            }
            uint _e188 = v1_1;
            v2_1 = _e188;
            v3_1 = (_e176 ? false : true);
        }
        uint _e191 = v2_1;
        bool _e193 = v3_1;
        uint _e194 = (_e193 ? _e170.member_1[0] : _e191);
        uint _e195 = (_e194 * _e159);
        v4_1 = 0u;
        if ((_e195 < _e141)) {
            uint _e198 = lightbvh_trails.list[_e195];
            v4_1 = _e198;
        }
        uint _e200 = v4_1;
        v6_1 = 0u;
        v7_1 = true;
        if ((_e159 == 2u)) {
            uint _e202 = (_e195 + 1u);
            bool _e203 = (_e202 < _e141);
            v5_1 = 0u;
            if (_e203) {
                uint _e205 = lightbvh_trails.list[_e202];
                v5_1 = _e205;
            }
            uint _e207 = v5_1;
            v6_1 = _e207;
            v7_1 = (_e203 ? false : true);
        }
        uint _e210 = v6_1;
        bool _e212 = v7_1;
        uint _e213 = (_e212 ? 0u : _e210);
        v8_1 = false;
        v9_1 = LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u));
        if (_e178) {
            uint _e220 = (_e153 + _e177);
            v10_1 = 4294967295u;
            if ((_e220 < _e141)) {
                uint _e223 = lightbvh_trails.list[_e220];
                v10_1 = _e223;
            }
            uint _e225 = v10_1;
            v13_1 = 0u;
            v14_1 = true;
            if ((_e225 != 4294967295u)) {
                bool _e227 = (_e225 >= 2147483648u);
                v12_1 = 0u;
                if (_e227) {
                    uint _e231 = (_e156 + ((_e225 - 2147483648u) + (_e200 & 7u)));
                    v11_1 = 4294967295u;
                    if ((_e231 < _e141)) {
                        uint _e234 = lightbvh_trails.list[_e231];
                        v11_1 = _e234;
                    }
                    uint _e236 = v11_1;
                    v12_1 = _e236;
                }
                uint _e238 = v12_1;
                v13_1 = _e238;
                v14_1 = (_e227 ? false : true);
            }
            uint _e241 = v13_1;
            bool _e243 = v14_1;
            v15_1 = 0u;
            v16_1 = LightbvhType23_(0u, 0u);
            v17_1 = (_e243 ? _e225 : _e241);
            bool loop_init_3 = true;
            while(true) {
                if (!loop_init_3) {
                    v15_1 = v22_1;
                    v16_1 = v23_1;
                    v17_1 = v24_1;
                    v26_1 = false;
                    if (!(v25_1)) {
                        break;
                    }
                }
                loop_init_3 = false;
                uint _e246 = v15_1;
                LightbvhType23_ _e248 = v16_1;
                uint _e250 = v17_1;
                v27_1 = _e248;
                v22_1 = 0u;
                v23_1 = LightbvhType23_(0u, 0u);
                v24_1 = 0u;
                v25_1 = false;
                if ((_e250 < 2147483648u)) {
                    bool _e252 = (_e246 < 20u);
                    v19_1 = 0u;
                    v20_1 = LightbvhType23_(0u, 0u);
                    v21_1 = 0u;
                    if (_e252) {
                        uint _e271 = (_e150 + (_e250 >> 3u));
                        v18_1 = 4294967295u;
                        if ((_e271 < _e141)) {
                            uint _e274 = lightbvh_trails.list[_e271];
                            v18_1 = _e274;
                        }
                        uint _e276 = v18_1;
                        v19_1 = (_e246 + 1u);
                        v20_1 = LightbvhType23_((((_e248.member << 3u) | ((_e250 & 7u) & 7u)) & 1073741823u), (((_e248.member_1 << 3u) | ((_e248.member >> 27u) & 7u)) & 1073741823u));
                        v21_1 = _e276;
                    }
                    uint _e279 = v19_1;
                    LightbvhType23_ _e281 = v20_1;
                    uint _e283 = v21_1;
                    v22_1 = _e279;
                    v23_1 = _e281;
                    v24_1 = _e283;
                    v25_1 = _e252;
                }
                uint _e285 = v22_1;
                LightbvhType23_ _e287 = v23_1;
                uint _e289 = v24_1;
                bool _e291 = v25_1;
                continue;
            }
            bool _e294 = v26_1;
            if (_e294) {
                break;
            }
            LightbvhType23_ _e297 = v27_1;
            v8_1 = _e294;
            v9_1 = LightbvhType24_(_e297, LightbvhType23_(_e200, _e213));
        }
        bool _e215 = v8_1;
        LightbvhType24_ _e217 = v9_1;
        v28_1 = _e215;
        v29_1 = _e217;
        if (_e178) {
        } else {
            v28_1 = false;
            v29_1 = LightbvhType24_(LightbvhType23_(_e200, _e213), LightbvhType23_(0u, 0u));
        }
        bool _e300 = v28_1;
        LightbvhType24_ _e302 = v29_1;
        bool _e304 = (_e168 == 0u);
        LightbvhType26_ _e305 = LightbvhType26_(_e302, LightbvhType23_(0u, 0u), _e170.member, LightbvhType25_(0.0, 1.0), 0u, (_e147 + _e144), 4294967295u, 4294967295u, 0u, 4194304u, 0u, _e168, _e304, true);
        uint _e308 = (uint(21) - uint(findMSB(4128767u)));
        uint _e310 = ((_e308 < 22u) ? _e308 : 22u);
        uint _e311 = (_e310 & 31u);
        LightbvhType26_ _e329 = LightbvhType26_(_e305.member, LightbvhType23_((4227858432u << _e311), 0u), _e305.member_2, _e305.member_3, _e305.member_4, _e305.member_5, _e305.member_6, _e305.member_7, _e305.member_8, _e305.member_9, _e305.member_10, _e305.member_11, _e305.member_12, _e305.member_13);
        LightbvhType26_ _e346 = LightbvhType26_(_e329.member, _e329.member_1, _e329.member_2, _e329.member_3, _e329.member_4, _e329.member_5, _e329.member_6, _e329.member_7, _e329.member_8, (4128768u << _e311), _e329.member_10, _e329.member_11, _e329.member_12, _e329.member_13);
        v30_1 = _e300;
        v31_1 = LightbvhType26_(_e346.member, _e346.member_1, _e346.member_2, _e346.member_3, _e346.member_4, _e346.member_5, _e346.member_6, _e346.member_7, _e346.member_8, _e346.member_9, _e310, _e346.member_11, _e346.member_12, _e346.member_13);
        v32_1 = _e304;
        bool loop_init_4 = true;
        while(true) {
            if (!loop_init_4) {
                v30_1 = v55_1;
                v31_1 = v56_1;
                v32_1 = v57_1;
                v58_1 = v55_1;
                if (!((v32_1 ? false : true))) {
                    break;
                }
            }
            loop_init_4 = false;
            bool _e363 = v30_1;
            LightbvhType26_ _e365 = v31_1;
            bool _e367 = v32_1;
            v59_1 = _e365;
            v60_1 = _e365;
            v61_1 = _e365;
            v62_1 = _e365;
            v55_1 = _e363;
            v56_1 = LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false);
            v57_1 = false;
            if (_e367) {
            } else {
                bool _e369 = (_e365.member_5 < _e135);
                uint _e370 = (_e369 ? _e365.member_5 : 0u);
                if ((_e370 < _e135)) {
                } else {
                    v58_1 = true;
                    break;
                }
                uint _e393 = lightbvh_nodes.list[_e370][0u][0u];
                uint _e398 = lightbvh_nodes.list[_e370][0u][1u];
                uint _e403 = lightbvh_nodes.list[_e370][0u][2u];
                uint _e408 = lightbvh_nodes.list[_e370][0u][3u];
                int _e411 = (int((_e408 & 255u)) - 127);
                float _e412 = (uintBitsToFloat(_e393) - _e365.member_2.member[0]);
                float _e413 = (uintBitsToFloat(_e398) - _e365.member_2.member[1]);
                float _e414 = (uintBitsToFloat(_e403) - _e365.member_2.member[2]);
                float _e417 = uintBitsToFloat((floatBitsToUint(_e412) & 2147483647u));
                float _e420 = uintBitsToFloat((floatBitsToUint(_e413) & 2147483647u));
                float _e423 = uintBitsToFloat((floatBitsToUint(_e414) & 2147483647u));
                float _e425 = ((_e417 > _e420) ? _e417 : _e420);
                int _e433 = (int(((floatBitsToUint(((_e425 > _e423) ? _e425 : _e423)) >> uint(23)) & 255u)) - 127);
                int _e435 = ((_e433 > _e411) ? _e433 : _e411);
                int _e436 = (_e411 - _e435);
                int _e438 = ((_e436 < -40) ? -40 : _e436);
                int _e439 = -(_e435);
                int _e441 = ((_e439 < -126) ? -126 : _e439);
                float _e448 = uintBitsToFloat((uint((((_e441 > 127) ? 127 : _e441) + 127)) << uint(23)));
                int _e453 = ((_e438 < -126) ? -126 : _e438);
                float _e460 = uintBitsToFloat((uint((((_e453 > 127) ? 127 : _e453) + 127)) << uint(23)));
                float _e468 = (_e460 * 4.656613e-10);
                float _e480 = (2.0 * 8.0);
                float _e481 = (uintBitsToFloat((floatBitsToUint(_e365.member_2.member_1[0]) & 2147483647u)) * _e480);
                float _e482 = (uintBitsToFloat((floatBitsToUint(_e365.member_2.member_1[1]) & 2147483647u)) * _e480);
                float _e483 = (uintBitsToFloat((floatBitsToUint(_e365.member_2.member_1[2]) & 2147483647u)) * _e480);
                v0_1 = float[8](0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
                v33_1 = LightbvhType23_(0u, 8u);
                bool loop_init_5 = true;
                while(true) {
                    if (!loop_init_5) {
                        v33_1 = v36_1;
                        v38_1 = _e363;
                        if (!((int(v37_1.member) != 0))) {
                            break;
                        }
                    }
                    loop_init_5 = false;
                    LightbvhType23_ _e490 = v33_1;
                    bool _e493 = (_e490.member < _e490.member_1);
                    v34_1 = LightbvhType23_(0u, 0u);
                    v35_1 = LightbvhType23_(0u, 0u);
                    if (_e493) {
                        v34_1 = LightbvhType23_((_e490.member + 1u), _e490.member_1);
                        v35_1 = LightbvhType23_(1u, _e490.member);
                    }
                    LightbvhType23_ _e495 = v34_1;
                    LightbvhType23_ _e497 = v35_1;
                    v36_1 = _e495;
                    v37_1 = _e497;
                    if (_e493) {
                    } else {
                        v36_1 = _e490;
                        v37_1 = LightbvhType23_(0u, LightbvhType23_(0u, 0u).member_1);
                    }
                    LightbvhType23_ _e507 = v36_1;
                    LightbvhType23_ _e509 = v37_1;
                    bool _e513 = (int(_e509.member) != 0);
                    if (_e513) {
                        bool _e514 = (_e509.member_1 < 8u);
                        if (_e514) {
                        } else {
                            v38_1 = true;
                            break;
                        }
                        uint _e518 = lightbvh_nodes.list[_e370][1u][_e509.member_1];
                        if (_e514) {
                        } else {
                            v38_1 = true;
                            break;
                        }
                        uint _e522 = lightbvh_nodes.list[_e370][2u][_e509.member_1];
                        if (_e514) {
                        } else {
                            v38_1 = true;
                            break;
                        }
                        uint _e526 = lightbvh_nodes.list[_e370][3u][_e509.member_1];
                        if (_e514) {
                        } else {
                            v38_1 = true;
                            break;
                        }
                        uint _e530 = lightbvh_nodes.list[_e370][4u][_e509.member_1];
                        float _e546 = ((_e412 * _e448) + (float(int(_e518)) * _e468));
                        float _e547 = ((_e413 * _e448) + (float(int((_e518 << 15u))) * _e468));
                        float _e548 = ((_e414 * _e448) + (float(int(_e522)) * _e468));
                        float _e553 = uintBitsToFloat((((_e530 << 20u) & 267386880u) + (floatBitsToUint(_e460) + 4043309056u)));
                        float _e558 = (float(int((_e522 << 15u))) * 4.656613e-10);
                        float _e560 = float(int(_e526));
                        float _e564 = float(int((_e526 << 8u)));
                        float _e568 = float(int((_e526 << 16u)));
                        float _e572 = (float(int((_e526 & 255u))) * 0.003921569);
                        float _e589 = (_e553 * _e553);
                        float _e595 = ((((_e546 * _e546) + (_e547 * _e547)) + (_e548 * _e548)) + 8.881784e-16);
                        float _e599 = (_e595 + (1.25 * _e589));
                        float _e604 = uintBitsToFloat((1595932665u - (floatBitsToUint(_e599) >> uint(1))));
                        float _e609 = (_e604 * (0.70395225 * (2.3892446 - (_e599 * (_e604 * _e604)))));
                        float _e610 = (_e553 * _e609);
                        float _e615 = ((((_e365.member_2.member_1[0] * 4.656613e-10) * _e560) + ((_e365.member_2.member_1[1] * 4.656613e-10) * _e564)) + ((_e365.member_2.member_1[2] * 4.656613e-10) * _e568));
                        float _e620 = (0.03162278 + (_e610 * (1.0 + (_e558 * (_e615 * _e615)))));
                        float _e626 = (((((_e365.member_2.member_1[0] + _e365.member_2.member_1[0]) * _e546) + ((_e365.member_2.member_1[1] + _e365.member_2.member_1[1]) * _e547)) + ((_e365.member_2.member_1[2] + _e365.member_2.member_1[2]) * _e548)) * _e609);
                        float _e628 = (_e626 + ((((_e481 + _e482) + _e483) + ((((_e481 * 4.656613e-10) * float(int(_e530))) + ((_e482 * 4.656613e-10) * float(int((_e530 << 8u))))) + ((_e483 * 4.656613e-10) * float(int((_e530 << 16u)))))) * _e610));
                        float _e630 = ((_e628 > 0.0001) ? _e628 : 0.0001);
                        float _e636 = (uintBitsToFloat((floatBitsToUint(_e626) & 2147483647u)) + _e620);
                        float _e642 = (1.0 + _e558);
                        float _e648 = ((((_e560 * _e546) + (_e564 * _e547)) + (_e568 * _e548)) * (-2.0 * 4.656613e-10));
                        float _e651 = (_e553 * ((_e642 > _e572) ? _e642 : _e572));
                        float _e653 = (_e595 - (2.5 * _e589));
                        float _e655 = (0.25 * (_e648 * _e648));
                        float _e661 = ((((_e653 > _e655) ? _e653 : _e655) + 8.881784e-16) + (1.25 * (_e651 * _e651)));
                        float _e666 = uintBitsToFloat((1595932665u - (floatBitsToUint(_e661) >> uint(1))));
                        float _e671 = (_e666 * (0.70395225 * (2.3892446 - (_e661 * (_e666 * _e666)))));
                        float _e673 = ((_e553 * _e671) * _e642);
                        float _e677 = ((0.03162278 + _e673) + (_e572 * (0.5 - _e673)));
                        float _e678 = (_e648 * _e671);
                        float _e682 = (uintBitsToFloat((floatBitsToUint(_e678) & 2147483647u)) + _e677);
                        float _e691 = ((_e636 * _e682) * (_e595 + (0.5 * _e589)));
                        float _e694 = uintBitsToFloat((2129859015u - floatBitsToUint(_e691)));
                        if (_e514) {
                        } else {
                            v38_1 = true;
                            break;
                        }
                        v0_1[_e509.member_1] = ((uintBitsToFloat(((_e522 & 2047u) << 19u)) * (((((_e626 > 0.0) ? _e626 : 0.0) * _e636) + (_e620 * ((_e630 < _e620) ? _e630 : _e620))) * ((((_e678 > 0.0) ? _e678 : 0.0) * _e682) + (_e677 * _e677)))) * (_e694 * (2.0 - (_e691 * _e694))));
                    }
                    continue;
                }
                bool _e702 = v38_1;
                v58_1 = _e702;
                if (_e702) {
                    break;
                }
                float _e703[8] = v0_1;
                bool _e720 = (_e365.member_8 < 20u);
                v39_1 = 0u;
                if (_e720) {
                    bool _e743 = (_e365.member_8 < 10u);
                    v41_1 = _e365.member_8;
                    if (_e743) {
                    } else {
                        v41_1 = (_e365.member_8 - 10u);
                    }
                    uint _e746 = v41_1;
                    v39_1 = (((_e743 ? _e365.member.member.member : _e365.member.member.member_1) >> (((_e746 * 3u) & 31u) & 31u)) & 7u);
                }
                uint _e722 = v39_1;
                v42_1 = _e722;
                if (_e720) {
                } else {
                    uint _e727 = (_e365.member_8 - 20u);
                    bool _e728 = (_e727 < 10u);
                    v40_1 = _e727;
                    if (_e728) {
                    } else {
                        v40_1 = (_e365.member_8 - 30u);
                    }
                    uint _e731 = v40_1;
                    v42_1 = (((_e728 ? _e365.member.member_1.member : _e365.member.member_1.member_1) >> (((_e731 * 3u) & 31u) & 31u)) & 7u);
                }
                uint _e755 = v42_1;
                uint _e760 = (0u - ((_e703[1] > 0.0) ? 1u : 0u));
                uint _e761 = (1u & _e760);
                uint _e765 = (0u - ((_e703[2] > 0.0) ? 1u : 0u));
                uint _e768 = (_e761 ^ ((2u ^ _e761) & _e765));
                uint _e772 = (0u - ((_e703[3] > 0.0) ? 1u : 0u));
                uint _e775 = (_e768 ^ ((3u ^ _e768) & _e772));
                uint _e779 = (0u - ((_e703[4] > 0.0) ? 1u : 0u));
                uint _e782 = (_e775 ^ ((4u ^ _e775) & _e779));
                uint _e786 = (0u - ((_e703[5] > 0.0) ? 1u : 0u));
                uint _e789 = (_e782 ^ ((5u ^ _e782) & _e786));
                uint _e793 = (0u - ((_e703[6] > 0.0) ? 1u : 0u));
                uint _e796 = (_e789 ^ ((6u ^ _e789) & _e793));
                uint _e800 = (0u - ((_e703[7] > 0.0) ? 1u : 0u));
                uint _e803 = (_e796 ^ ((7u ^ _e796) & _e800));
                float _e806 = ((((0.0 + _e703[0]) + _e703[4]) + ((0.0 + _e703[2]) + _e703[6])) + (((0.0 + _e703[1]) + _e703[5]) + ((0.0 + _e703[3]) + _e703[7])));
                bool _e807 = (_e806 > 0.0);
                float _e811 = (_e807 ? _e806 : 1.0);
                uint _e812 = floatBitsToUint(_e811);
                float _e817 = uintBitsToFloat(((_e812 & 2147483648u) | (2129859015u - (_e812 & 2147483647u))));
                float _e820 = (_e817 * (2.0 - (_e811 * _e817)));
                float _e824 = ((float(int(_e365.member_9)) * 0.9999695) * (_e820 * (2.0 - (_e811 * _e820))));
                v43_1 = 2147483647;
                if (_e365.member_13) {
                } else {
                    v43_1 = int((_e365.member_1.member >> 10u));
                }
                int _e827 = v43_1;
                int _e833 = int((floatBitsToUint(((_e703[0] * _e824) + 8388608.0)) & 8388607u));
                int _e840 = (((_e833 > 1) ? _e833 : 1) & int((0u - ((_e703[0] > 0.0) ? 1u : 0u))));
                uint _e841 = uint(_e840);
                uint _e842 = (_e841 & 4294967295u);
                int _e844 = int((_e365.member_13 ? _e755 : _e803));
                uint _e848 = (0u - (((_e840 <= _e827) && (0 < _e844)) ? 1u : 0u));
                uint _e849 = (_e841 & _e848);
                int _e855 = int((floatBitsToUint(((_e703[1] * _e824) + 8388608.0)) & 8388607u));
                int _e860 = (_e840 + (((_e855 > 1) ? _e855 : 1) & int(_e760)));
                uint _e861 = uint(_e860);
                uint _e864 = (_e842 ^ ((_e861 ^ _e842) & _e848));
                uint _e869 = (0u - (((_e860 <= _e827) && (1 < _e844)) ? 1u : 0u));
                uint _e872 = (_e849 ^ ((_e861 ^ _e849) & _e869));
                int _e879 = int((floatBitsToUint(((_e703[2] * _e824) + 8388608.0)) & 8388607u));
                int _e884 = (_e860 + (((_e879 > 1) ? _e879 : 1) & int(_e765)));
                uint _e885 = uint(_e884);
                uint _e888 = (_e864 ^ ((_e885 ^ _e864) & _e869));
                uint _e893 = (0u - (((_e884 <= _e827) && (2 < _e844)) ? 1u : 0u));
                uint _e896 = (_e872 ^ ((_e885 ^ _e872) & _e893));
                int _e903 = int((floatBitsToUint(((_e703[3] * _e824) + 8388608.0)) & 8388607u));
                int _e908 = (_e884 + (((_e903 > 1) ? _e903 : 1) & int(_e772)));
                uint _e909 = uint(_e908);
                uint _e912 = (_e888 ^ ((_e909 ^ _e888) & _e893));
                uint _e917 = (0u - (((_e908 <= _e827) && (3 < _e844)) ? 1u : 0u));
                uint _e920 = (_e896 ^ ((_e909 ^ _e896) & _e917));
                int _e927 = int((floatBitsToUint(((_e703[4] * _e824) + 8388608.0)) & 8388607u));
                int _e932 = (_e908 + (((_e927 > 1) ? _e927 : 1) & int(_e779)));
                uint _e933 = uint(_e932);
                uint _e936 = (_e912 ^ ((_e933 ^ _e912) & _e917));
                uint _e941 = (0u - (((_e932 <= _e827) && (4 < _e844)) ? 1u : 0u));
                uint _e944 = (_e920 ^ ((_e933 ^ _e920) & _e941));
                int _e951 = int((floatBitsToUint(((_e703[5] * _e824) + 8388608.0)) & 8388607u));
                int _e956 = (_e932 + (((_e951 > 1) ? _e951 : 1) & int(_e786)));
                uint _e957 = uint(_e956);
                uint _e960 = (_e936 ^ ((_e957 ^ _e936) & _e941));
                uint _e965 = (0u - (((_e956 <= _e827) && (5 < _e844)) ? 1u : 0u));
                uint _e968 = (_e944 ^ ((_e957 ^ _e944) & _e965));
                int _e975 = int((floatBitsToUint(((_e703[6] * _e824) + 8388608.0)) & 8388607u));
                int _e980 = (_e956 + (((_e975 > 1) ? _e975 : 1) & int(_e793)));
                uint _e981 = uint(_e980);
                uint _e984 = (_e960 ^ ((_e981 ^ _e960) & _e965));
                uint _e989 = (0u - (((_e980 <= _e827) && (6 < _e844)) ? 1u : 0u));
                uint _e992 = (_e968 ^ ((_e981 ^ _e968) & _e989));
                int _e999 = int((floatBitsToUint(((_e703[7] * _e824) + 8388608.0)) & 8388607u));
                int _e1004 = (_e980 + (((_e999 > 1) ? _e999 : 1) & int(_e800)));
                uint _e1005 = uint(_e1004);
                uint _e1008 = (_e984 ^ ((_e1005 ^ _e984) & _e989));
                uint _e1013 = (0u - (((_e1004 <= _e827) && (7 < _e844)) ? 1u : 0u));
                uint _e1016 = (_e992 ^ ((_e1005 ^ _e992) & _e1013));
                uint _e1019 = (_e365.member_13 ? _e755 : ((((((((_e848 & 1u) + (_e869 & 1u)) + (_e893 & 1u)) + (_e917 & 1u)) + (_e941 & 1u)) + (_e965 & 1u)) + (_e989 & 1u)) + (_e1013 & 1u)));
                bool _e1024 = (_e1019 < 8u);
                bool _e1025 = ((_e807 && (_e1008 > _e1016)) && _e1024);
                uint _e1026 = (_e1024 ? _e1019 : 0u);
                v44_1 = 0u;
                if (_e1025) {
                    v44_1 = (((_e1019 == _e803) ? _e365.member_9 : _e1008) - _e1016);
                }
                uint _e1030 = v44_1;
                bool _e1031 = (_e1026 < 8u);
                if (_e1031) {
                } else {
                    v58_1 = true;
                    break;
                }
                uint _e1035 = lightbvh_nodes.list[_e370][1u][_e1026];
                uint _e1036 = (_e1035 & 3u);
                if (_e1031) {
                } else {
                    v58_1 = true;
                    break;
                }
                uint _e1040 = lightbvh_nodes.list[_e370][5u][_e1026];
                bool _e1044 = ((_e369 && (_e1030 > 0u)) && (_e1030 <= _e365.member_9));
                uint _e1045 = (_e1044 ? _e1030 : 1u);
                uint _e1047 = ((_e1045 - 1u) & 4194303u);
                uint _e1053 = (((_e1047 == 0u) ? 32u : (uint(31) - uint(findMSB(_e1047)))) - 10u);
                uint _e1055 = ((_e1053 < 22u) ? _e1053 : 22u);
                uint _e1067 = (_e1055 & 31u);
                LightbvhType26_ _e1088 = LightbvhType26_(_e365.member, LightbvhType23_((((_e365.member_1.member - ((_e1025 ? _e1016 : 0u) << 10u)) << _e1067) | ((_e365.member_1.member_1 >> uint(1)) >> ((31u - _e1055) & 31u))), (_e365.member_1.member_1 << _e1067)), _e365.member_2, _e365.member_3, _e365.member_4, _e365.member_5, _e365.member_6, _e365.member_7, _e365.member_8, _e365.member_9, _e365.member_10, _e365.member_11, _e365.member_12, _e365.member_13);
                LightbvhType26_ _e1105 = LightbvhType26_(_e1088.member, _e1088.member_1, _e1088.member_2, _e1088.member_3, _e1088.member_4, _e1088.member_5, _e1088.member_6, _e1088.member_7, _e1088.member_8, (_e1045 << _e1067), _e1088.member_10, _e1088.member_11, _e1088.member_12, _e1088.member_13);
                LightbvhType26_ _e1122 = LightbvhType26_(_e1105.member, _e1105.member_1, _e1105.member_2, _e1105.member_3, _e1105.member_4, _e1105.member_5, _e1105.member_6, _e1105.member_7, _e1105.member_8, _e1105.member_9, (_e365.member_10 + _e1055), _e1105.member_11, _e1105.member_12, _e1105.member_13);
                uint _e1123 = (_e365.member_8 + 1u);
                v45_1 = true;
                if ((_e1123 == 20u)) {
                } else {
                    v45_1 = (_e1123 == 40u);
                }
                bool _e1127 = v45_1;
                uint _e1128 = (_e1040 & 134217727u);
                uint _e1132 = (_e1040 >> (uint(findLSB(134217728u)) & 31u));
                bool _e1136 = (_e1128 < _e138);
                bool _e1137 = (((_e1044 && (_e1036 == 3u)) && _e720) && _e1136);
                bool _e1141 = ((_e1044 && (_e1036 == 1u)) && !(_e1127));
                LightbvhType26_ _e1159 = LightbvhType26_(_e1122.member, _e1122.member_1, _e1122.member_2, _e1122.member_3, _e1122.member_4, _e1122.member_5, ((_e1044 && (_e1036 == 2u)) ? _e1040 : 4294967295u), _e1122.member_7, _e1122.member_8, _e1122.member_9, _e1122.member_10, _e1122.member_11, _e1122.member_12, _e1122.member_13);
                uint _e1161 = (_e365.member_11 - 1u);
                LightbvhType26_ _e1176 = LightbvhType26_(_e1159.member, _e1159.member_1, _e1159.member_2, _e1159.member_3, _e1159.member_4, _e1159.member_5, _e1159.member_6, _e1159.member_7, _e1159.member_8, _e1159.member_9, _e1159.member_10, _e1161, _e1159.member_12, _e1159.member_13);
                bool _e1180 = (!((_e1137 || _e1141)) || (_e1161 == 0u));
                LightbvhType26_ _e1195 = LightbvhType26_(_e1176.member, _e1176.member_1, _e1176.member_2, _e1176.member_3, _e1176.member_4, _e1176.member_5, _e1176.member_6, _e1176.member_7, _e1176.member_8, _e1176.member_9, _e1176.member_10, _e1176.member_11, _e1180, _e1176.member_13);
                v46_1 = LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false);
                if (_e1137) {
                    if (_e1136) {
                    } else {
                        v58_1 = true;
                        break;
                    }
                    LightbvhType26_ _e1248 = LightbvhType26_(_e1195.member, _e1195.member_1, _e1195.member_2, _e1195.member_3, _e1195.member_4, _e1195.member_5, _e1195.member_6, _e1128, _e1195.member_8, _e1195.member_9, _e1195.member_10, _e1195.member_11, _e1195.member_12, _e1195.member_13);
                    uint _e1251 = lightbvh_instances.list[_e1128].root;
                    LightbvhType26_ _e1266 = LightbvhType26_(_e1248.member, _e1248.member_1, _e1248.member_2, _e1248.member_3, _e1248.member_4, _e1251, _e1248.member_6, _e1248.member_7, _e1248.member_8, _e1248.member_9, _e1248.member_10, _e1248.member_11, _e1248.member_12, _e1248.member_13);
                    bool _e1267 = (_e1251 == 4294967295u);
                    v48_1 = 4294967295u;
                    if (_e1267) {
                        uint _e1270 = lightbvh_instances.list[_e1128].first_light;
                        v48_1 = _e1270;
                    }
                    uint _e1272 = v48_1;
                    LightbvhType26_ _e1287 = LightbvhType26_(_e1266.member, _e1266.member_1, _e1266.member_2, _e1266.member_3, _e1266.member_4, _e1266.member_5, _e1272, _e1266.member_7, _e1266.member_8, _e1266.member_9, _e1266.member_10, _e1266.member_11, _e1266.member_12, _e1266.member_13);
                    bool _e1288 = (_e1180 || _e1267);
                    LightbvhType26_ _e1303 = LightbvhType26_(_e1287.member, _e1287.member_1, _e1287.member_2, _e1287.member_3, _e1287.member_4, _e1287.member_5, _e1287.member_6, _e1287.member_7, _e1287.member_8, _e1287.member_9, _e1287.member_10, _e1287.member_11, _e1288, _e1287.member_13);
                    LightbvhType26_ _e1318 = LightbvhType26_(_e1303.member, _e1303.member_1, _e1303.member_2, _e1303.member_3, _e1303.member_4, _e1303.member_5, _e1303.member_6, _e1303.member_7, 20u, _e1303.member_9, _e1303.member_10, _e1303.member_11, _e1303.member_12, _e1303.member_13);
                    v49_1 = _e1318;
                    if ((_e1132 > 0u)) {
                        uint _e1321 = ((_e1251 < _e135) ? _e1251 : 0u);
                        if ((_e1321 < _e135)) {
                        } else {
                            v58_1 = true;
                            break;
                        }
                        uint _e1324 = ((_e1132 - 1u) % 8u);
                        bool _e1325 = (_e1324 < 8u);
                        if (_e1325) {
                        } else {
                            v58_1 = true;
                            break;
                        }
                        uint _e1329 = lightbvh_nodes.list[_e1321][1u][_e1324];
                        uint _e1330 = (_e1329 & 3u);
                        if (_e1325) {
                        } else {
                            v58_1 = true;
                            break;
                        }
                        uint _e1334 = lightbvh_nodes.list[_e1321][5u][_e1324];
                        LightbvhType26_ _e1349 = LightbvhType26_(_e1318.member, _e1318.member_1, _e1318.member_2, _e1318.member_3, _e1318.member_4, _e1334, _e1318.member_6, _e1318.member_7, _e1318.member_8, _e1318.member_9, _e1318.member_10, _e1318.member_11, _e1318.member_12, _e1318.member_13);
                        LightbvhType26_ _e1366 = LightbvhType26_(_e1349.member, _e1349.member_1, _e1349.member_2, _e1349.member_3, _e1349.member_4, _e1349.member_5, ((_e1330 == 2u) ? _e1334 : 4294967295u), _e1349.member_7, _e1349.member_8, _e1349.member_9, _e1349.member_10, _e1349.member_11, _e1349.member_12, _e1349.member_13);
                        LightbvhType26_ _e1383 = LightbvhType26_(_e1366.member, _e1366.member_1, _e1366.member_2, _e1366.member_3, _e1366.member_4, _e1366.member_5, _e1366.member_6, _e1366.member_7, _e1366.member_8, _e1366.member_9, _e1366.member_10, _e1366.member_11, (_e1288 || (_e1330 != 1u)), _e1366.member_13);
                        v49_1 = LightbvhType26_(_e1383.member, _e1383.member_1, _e1383.member_2, _e1383.member_3, _e1383.member_4, _e1383.member_5, _e1383.member_6, _e1383.member_7, 21u, _e1383.member_9, _e1383.member_10, _e1383.member_11, _e1383.member_12, _e1383.member_13);
                    }
                    LightbvhType26_ _e1400 = v49_1;
                    float _e1410 = lightbvh_instances.list[_e1128].translation[0u];
                    float _e1414 = lightbvh_instances.list[_e1128].translation[1u];
                    float _e1418 = lightbvh_instances.list[_e1128].translation[2u];
                    float _e1419 = (_e170.member.member[0] - _e1410);
                    float _e1420 = (_e170.member.member[1] - _e1414);
                    float _e1421 = (_e170.member.member[2] - _e1418);
                    float _e1426 = ((uintBitsToFloat((floatBitsToUint(_e1419) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1419);
                    float _e1431 = ((uintBitsToFloat((floatBitsToUint(_e1420) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1420);
                    float _e1436 = ((uintBitsToFloat((floatBitsToUint(_e1421) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1421);
                    float _e1441 = lightbvh_instances.list[_e1128].inverse_[0u][0u];
                    float _e1446 = lightbvh_instances.list[_e1128].inverse_[0u][1u];
                    float _e1451 = lightbvh_instances.list[_e1128].inverse_[0u][2u];
                    float _e1459 = lightbvh_instances.list[_e1128].inverse_[1u][0u];
                    float _e1464 = lightbvh_instances.list[_e1128].inverse_[1u][1u];
                    float _e1469 = lightbvh_instances.list[_e1128].inverse_[1u][2u];
                    float _e1480 = lightbvh_instances.list[_e1128].inverse_[2u][0u];
                    float _e1485 = lightbvh_instances.list[_e1128].inverse_[2u][1u];
                    float _e1490 = lightbvh_instances.list[_e1128].inverse_[2u][2u];
                    float _e1494 = (((_e1441 * _e1426) + (_e1459 * _e1431)) + (_e1480 * _e1436));
                    float _e1495 = (((_e1446 * _e1426) + (_e1464 * _e1431)) + (_e1485 * _e1436));
                    float _e1496 = (((_e1451 * _e1426) + (_e1469 * _e1431)) + (_e1490 * _e1436));
                    float _e1507 = lightbvh_instances.list[_e1128].columns[0u][0u];
                    float _e1512 = lightbvh_instances.list[_e1128].columns[0u][1u];
                    float _e1517 = lightbvh_instances.list[_e1128].columns[0u][2u];
                    float _e1522 = (((_e1507 * _e170.member.member_1[0]) + (_e1512 * _e170.member.member_1[1])) + (_e1517 * _e170.member.member_1[2]));
                    float _e1527 = lightbvh_instances.list[_e1128].columns[1u][0u];
                    float _e1532 = lightbvh_instances.list[_e1128].columns[1u][1u];
                    float _e1537 = lightbvh_instances.list[_e1128].columns[1u][2u];
                    float _e1542 = (((_e1527 * _e170.member.member_1[0]) + (_e1532 * _e170.member.member_1[1])) + (_e1537 * _e170.member.member_1[2]));
                    float _e1547 = lightbvh_instances.list[_e1128].columns[2u][0u];
                    float _e1552 = lightbvh_instances.list[_e1128].columns[2u][1u];
                    float _e1557 = lightbvh_instances.list[_e1128].columns[2u][2u];
                    float _e1562 = (((_e1547 * _e170.member.member_1[0]) + (_e1552 * _e170.member.member_1[1])) + (_e1557 * _e170.member.member_1[2]));
                    float _e1567 = ((uintBitsToFloat((floatBitsToUint(_e1522) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1522);
                    float _e1572 = ((uintBitsToFloat((floatBitsToUint(_e1542) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1542);
                    float _e1577 = ((uintBitsToFloat((floatBitsToUint(_e1562) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1562);
                    float _e1582 = (((_e1567 * _e1567) + (_e1572 * _e1572)) + (_e1577 * _e1577));
                    v50_1 = 0.0;
                    if ((_e1582 >= uintBitsToFloat(67108864u))) {
                        float _e1589 = uintBitsToFloat((1597463007u - (floatBitsToUint(_e1582) >> uint(1))));
                        float _e1590 = (0.5 * _e1582);
                        float _e1594 = (_e1589 * (1.5 - ((_e1590 * _e1589) * _e1589)));
                        v50_1 = (_e1594 * (1.5 - ((_e1590 * _e1594) * _e1594)));
                    }
                    float _e1600 = v50_1;
                    float _e1601 = -(1.1529215e18);
                    v51_1 = _e1601;
                    if ((_e1494 < _e1601)) {
                    } else {
                        v51_1 = ((_e1494 > 1.1529215e18) ? 1.1529215e18 : _e1494);
                    }
                    float _e1606 = v51_1;
                    v52_1 = _e1601;
                    if ((_e1495 < _e1601)) {
                    } else {
                        v52_1 = ((_e1495 > 1.1529215e18) ? 1.1529215e18 : _e1495);
                    }
                    float _e1616 = v52_1;
                    v53_1 = _e1601;
                    if ((_e1496 < _e1601)) {
                    } else {
                        v53_1 = ((_e1496 > 1.1529215e18) ? 1.1529215e18 : _e1496);
                    }
                    float _e1626 = v53_1;
                    float _e1633 = (_e1567 * _e1600);
                    float _e1639 = (_e1572 * _e1600);
                    float _e1645 = (_e1577 * _e1600);
                    v46_1 = LightbvhType26_(_e1400.member, _e1400.member_1, LightbvhType14_(float[3](((uintBitsToFloat((floatBitsToUint(_e1606) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1606), ((uintBitsToFloat((floatBitsToUint(_e1616) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1616), ((uintBitsToFloat((floatBitsToUint(_e1626) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1626)), float[3](((uintBitsToFloat((floatBitsToUint(_e1633) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1633), ((uintBitsToFloat((floatBitsToUint(_e1639) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1639), ((uintBitsToFloat((floatBitsToUint(_e1645) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1645))), _e1400.member_3, _e1400.member_4, _e1400.member_5, _e1400.member_6, _e1400.member_7, _e1400.member_8, _e1400.member_9, _e1400.member_10, _e1400.member_11, _e1400.member_12, _e1400.member_13);
                }
                LightbvhType26_ _e1197 = v46_1;
                v54_1 = _e1197;
                if (_e1137) {
                } else {
                    v47_1 = _e365.member_5;
                    if (_e1141) {
                        v47_1 = (_e1040 + (_e720 ? _e144 : 0u));
                    }
                    uint _e1201 = v47_1;
                    LightbvhType26_ _e1216 = LightbvhType26_(_e1195.member, _e1195.member_1, _e1195.member_2, _e1195.member_3, _e1195.member_4, _e1201, _e1195.member_6, _e1195.member_7, _e1195.member_8, _e1195.member_9, _e1195.member_10, _e1195.member_11, _e1195.member_12, _e1195.member_13);
                    v54_1 = LightbvhType26_(_e1216.member, _e1216.member_1, _e1216.member_2, _e1216.member_3, _e1216.member_4, _e1216.member_5, _e1216.member_6, _e1216.member_7, (_e365.member_8 + (_e1141 ? 1u : 0u)), _e1216.member_9, _e1216.member_10, _e1216.member_11, _e1216.member_12, _e1216.member_13);
                }
                LightbvhType26_ _e1669 = v54_1;
                v55_1 = _e702;
                v56_1 = _e1669;
                v57_1 = _e1669.member_12;
            }
            bool _e1672 = v55_1;
            LightbvhType26_ _e1674 = v56_1;
            bool _e1676 = v57_1;
            continue;
        }
        bool _e1680 = v58_1;
        if (_e1680) {
            break;
        }
        LightbvhType26_ _e1682 = v59_1;
        LightbvhType26_ _e1686 = v60_1;
        v63_1 = 0.0;
        if ((((_e1682.member_6 == _e194) && (_e1686.member_7 == _e177)) && (_e194 != 4294967295u))) {
            LightbvhType26_ _e1693 = v61_1;
            LightbvhType26_ _e1698 = v62_1;
            int _e1704 = -(int((22u + ((_e1693.member_10 < 98u) ? _e1693.member_10 : 98u))));
            int _e1706 = ((_e1704 < -126) ? -126 : _e1704);
            v63_1 = (float(int(_e1698.member_9)) * uintBitsToFloat((uint((((_e1706 > 127) ? 127 : _e1706) + 127)) << uint(23))));
        }
        float _e1716 = v63_1;
        v65_1 = 0u;
        v66_1 = true;
        if (_e176) {
            v64_1 = 0u;
            if (_e178) {
                uint _e1719 = lightbvh_instances.list[_e177].count;
                v64_1 = _e1719;
            }
            uint _e1721 = v64_1;
            v65_1 = _e1721;
            v66_1 = (_e178 ? false : true);
        }
        uint _e1724 = v65_1;
        bool _e1726 = v66_1;
        uint _e1731 = ((_e1726 ? _e165 : _e1724) & 2147483647u);
        uint _e1736 = floatBitsToUint((float(65536) * uintBitsToFloat(880803840u)));
        uint _e1737 = floatBitsToUint(float(int(((_e1731 > 0u) ? _e1731 : 1u))));
        uint _e1742 = ((_e1736 >> uint(23)) & 255u);
        uint _e1746 = (_e1736 & 8388607u);
        uint _e1747 = (_e1746 | 8388608u);
        uint _e1748 = (_e1737 & 8388607u);
        uint _e1749 = (_e1748 | 8388608u);
        bool _e1750 = (_e1747 < _e1749);
        float _e1754 = uintBitsToFloat((_e1748 | 1065353216u));
        uint _e1755 = floatBitsToUint(_e1754);
        float _e1760 = uintBitsToFloat(((_e1755 & 2147483648u) | (2129859015u - (_e1755 & 2147483647u))));
        float _e1763 = (_e1760 * (2.0 - (_e1754 * _e1760)));
        float _e1766 = (_e1763 * (2.0 - (_e1754 * _e1763)));
        float _e1770 = ((uintBitsToFloat((_e1746 | 1065353216u)) * _e1766) * (_e1750 ? 16777216.0 : 8388608.0));
        float _e1771 = uintBitsToFloat(0u);
        float _e1772 = uintBitsToFloat(1333788671u);
        uint _e1777 = ((_e1770 > _e1772) ? 4294967295u : ((_e1770 < _e1771) ? 0u : uint(_e1770)));
        int _e1783 = int(((_e1747 << uint(((_e1750 ? 24 : 23) & 31))) - (_e1777 * _e1749)));
        float _e1788 = ((float((_e1783 >> uint(8))) * _e1766) * 3.0517578e-5);
        float _e1789 = uintBitsToFloat(3472883712u);
        float _e1790 = uintBitsToFloat(1325400063u);
        int _e1797 = ((_e1788 == _e1788) ? ((_e1788 > _e1790) ? 2147483647 : ((_e1788 < _e1789) ? -2147483648 : int(_e1788))) : 0);
        uint _e1799 = (_e1777 + uint(_e1797));
        int _e1800 = int(_e1749);
        int _e1802 = (_e1783 - (_e1797 * _e1800));
        bool _e1803 = (_e1802 < 0);
        v67_1 = _e1799;
        if (_e1803) {
            v67_1 = (_e1799 - 1u);
        }
        uint _e1806 = v67_1;
        v68_1 = _e1802;
        if (_e1803) {
            v68_1 = (_e1802 + _e1800);
        }
        int _e1809 = v68_1;
        bool _e1810 = (_e1809 >= _e1800);
        v69_1 = _e1806;
        if (_e1810) {
            v69_1 = (_e1806 + 1u);
        }
        uint _e1813 = v69_1;
        v70_1 = _e1809;
        if (_e1810) {
            v70_1 = (_e1809 - _e1800);
        }
        int _e1816 = v70_1;
        v71_1 = _e1813;
        if (((_e1816 * 2) > _e1800)) {
            v71_1 = (_e1813 + 1u);
        }
        uint _e1821 = v71_1;
        int _e1826 = ((int(_e1742) - int(((_e1737 >> uint(23)) & 255u))) + (_e1750 ? 126 : 127));
        v74_1 = 0u;
        v75_1 = true;
        if ((_e1742 == 0u)) {
        } else {
            bool _e1828 = (_e1826 <= 0);
            v73_1 = 0u;
            if (_e1828) {
            } else {
                v72_1 = 2139095040u;
                if ((_e1826 >= 255)) {
                } else {
                    v72_1 = ((uint(_e1826) << uint(23)) + (_e1821 & 8388607u));
                }
                uint _e1836 = v72_1;
                v73_1 = _e1836;
            }
            uint _e1838 = v73_1;
            v74_1 = _e1838;
            v75_1 = _e1828;
        }
        uint _e1840 = v74_1;
        bool _e1842 = v75_1;
        uint _e1846 = (_e162 & 2147483647u);
        uint _e1851 = floatBitsToUint(uintBitsToFloat((((_e1736 ^ _e1737) & 2147483648u) | (_e1842 ? 0u : _e1840))));
        uint _e1852 = floatBitsToUint(float(int(((_e1846 > 0u) ? _e1846 : 1u))));
        uint _e1857 = ((_e1851 >> uint(23)) & 255u);
        uint _e1861 = (_e1851 & 8388607u);
        uint _e1862 = (_e1861 | 8388608u);
        uint _e1863 = (_e1852 & 8388607u);
        uint _e1864 = (_e1863 | 8388608u);
        bool _e1865 = (_e1862 < _e1864);
        float _e1869 = uintBitsToFloat((_e1863 | 1065353216u));
        uint _e1870 = floatBitsToUint(_e1869);
        float _e1875 = uintBitsToFloat(((_e1870 & 2147483648u) | (2129859015u - (_e1870 & 2147483647u))));
        float _e1878 = (_e1875 * (2.0 - (_e1869 * _e1875)));
        float _e1881 = (_e1878 * (2.0 - (_e1869 * _e1878)));
        float _e1885 = ((uintBitsToFloat((_e1861 | 1065353216u)) * _e1881) * (_e1865 ? 16777216.0 : 8388608.0));
        uint _e1890 = ((_e1885 > _e1772) ? 4294967295u : ((_e1885 < _e1771) ? 0u : uint(_e1885)));
        int _e1896 = int(((_e1862 << uint(((_e1865 ? 24 : 23) & 31))) - (_e1890 * _e1864)));
        float _e1901 = ((float((_e1896 >> uint(8))) * _e1881) * 3.0517578e-5);
        int _e1908 = ((_e1901 == _e1901) ? ((_e1901 > _e1790) ? 2147483647 : ((_e1901 < _e1789) ? -2147483648 : int(_e1901))) : 0);
        uint _e1910 = (_e1890 + uint(_e1908));
        int _e1911 = int(_e1864);
        int _e1913 = (_e1896 - (_e1908 * _e1911));
        bool _e1914 = (_e1913 < 0);
        v76_1 = _e1910;
        if (_e1914) {
            v76_1 = (_e1910 - 1u);
        }
        uint _e1917 = v76_1;
        v77_1 = _e1913;
        if (_e1914) {
            v77_1 = (_e1913 + _e1911);
        }
        int _e1920 = v77_1;
        bool _e1921 = (_e1920 >= _e1911);
        v78_1 = _e1917;
        if (_e1921) {
            v78_1 = (_e1917 + 1u);
        }
        uint _e1924 = v78_1;
        v79_1 = _e1920;
        if (_e1921) {
            v79_1 = (_e1920 - _e1911);
        }
        int _e1927 = v79_1;
        v80_1 = _e1924;
        if (((_e1927 * 2) > _e1911)) {
            v80_1 = (_e1924 + 1u);
        }
        uint _e1932 = v80_1;
        int _e1937 = ((int(_e1857) - int(((_e1852 >> uint(23)) & 255u))) + (_e1865 ? 126 : 127));
        v83_1 = 0u;
        v84_1 = true;
        if ((_e1857 == 0u)) {
        } else {
            bool _e1939 = (_e1937 <= 0);
            v82_1 = 0u;
            if (_e1939) {
            } else {
                v81_1 = 2139095040u;
                if ((_e1937 >= 255)) {
                } else {
                    v81_1 = ((uint(_e1937) << uint(23)) + (_e1932 & 8388607u));
                }
                uint _e1947 = v81_1;
                v82_1 = _e1947;
            }
            uint _e1949 = v82_1;
            v83_1 = _e1949;
            v84_1 = _e1939;
        }
        uint _e1951 = v83_1;
        bool _e1953 = v84_1;
        v85_1 = false;
        if (_e176) {
            v86_1 = false;
            if (_e178) {
                uint _e1962 = lightbvh_instances.list[_e177].first;
                uint _e1966 = lightbvh_instances.list[_e177].count;
                v86_1 = ((_e170.member_1[0] - _e1962) < _e1966);
            }
            bool _e1969 = v86_1;
            v85_1 = _e1969;
        }
        bool _e1958 = v85_1;
        v87_1 = _e1958;
        if (_e176) {
        } else {
            v87_1 = (_e170.member_1[0] < _e165);
        }
        bool _e1971 = v87_1;
        v88_1 = 0.0;
        if (_e1971) {
            v88_1 = (_e1716 + uintBitsToFloat((((_e1851 ^ _e1852) & 2147483648u) | (_e1953 ? 0u : _e1951))));
        }
        float _e1974 = v88_1;
        results_1 = _e1974;
        break;
    } while(false);
    float _e2065 = results_1;
    return _e2065;
}

LightbvhLightPoint lightbvh_light_point(uint light_1, uint instance_1, vec2 numbers) {
    LightbvhType19_ samples = LightbvhType19_(0u, 0u, 0.0);
    float numbers_1[2] = float[2](0.0, 0.0);
    LightbvhType34_ results_2 = LightbvhType34_(float[3](0.0, 0.0, 0.0), 0.0, float[3](0.0, 0.0, 0.0), 0u, float[3](0.0, 0.0, 0.0));
    float v0_2 = 0.0;
    float v1_2 = 0.0;
    float v2_2 = 0.0;
    float v3_2 = 0.0;
    float v4_2 = 0.0;
    float v5_2 = 0.0;
    float v6_2 = 0.0;
    float v7_2 = 0.0;
    float v8_2 = 0.0;
    float v9_2[3] = float[3](0.0, 0.0, 0.0);
    float v10_2[3] = float[3](0.0, 0.0, 0.0);
    float v11_2 = 0.0;
    float v12_2 = 0.0;
    float v13_2 = 0.0;
    LightbvhLight v14_2 = LightbvhLight(float[3][3](float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), float[3](0.0, 0.0, 0.0), 0u, 0u);
    LightbvhLight v15_2 = LightbvhLight(float[3][3](float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), float[3](0.0, 0.0, 0.0), 0u, 0u);
    LightbvhLight v16_2 = LightbvhLight(float[3][3](float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), float[3](0.0, 0.0, 0.0), 0u, 0u);
    uint v17_2 = 0u;
    int v18_2 = 0;
    int v19_2 = 0;
    uint v20_2 = 0u;
    uint v21_2 = 0u;
    float v22_2 = 0.0;
    uint v23_2 = 0u;
    int v24_2 = 0;
    uint v25_2 = 0u;
    int v26_2 = 0;
    uint v27_2 = 0u;
    uint v28_2 = 0u;
    uint v29_2 = 0u;
    float v30_2 = 0.0;
    float v31_2 = 0.0;
    float v32_2[3] = float[3](0.0, 0.0, 0.0);
    samples = LightbvhType19_(light_1, instance_1, 0.0);
    numbers_1 = float[2](numbers.x, numbers.y);
    do {
        uint _e77 = samples.member;
        uint _e80 = samples.member_1;
        uint _e82 = ((_e80 == 4294967295u) ? 0u : _e80);
        v16_2 = LightbvhLight(float[3][3](float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), float[3](0.0, 0.0, 0.0), 4294967295u, 0u);
        if ((_e82 < uint(lightbvh_instances.list.length()))) {
            LightbvhInstance _e86 = lightbvh_instances.list[_e82];
            uint _e88 = (_e77 - _e86.first);
            uint _e90 = (_e88 + _e86.first_light);
            v15_2 = LightbvhLight(float[3][3](float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), float[3](0.0, 0.0, 0.0), 4294967295u, 0u);
            if ((_e88 < _e86.count)) {
                v14_2 = LightbvhLight(float[3][3](float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), float[3](0.0, 0.0, 0.0), 4294967295u, 0u);
                if ((_e90 < uint(lightbvh_lights.list.length()))) {
                    LightbvhLight _e96 = lightbvh_lights.list[_e90];
                    float _e115 = (_e86.columns[0][0] * _e96.p[0][0]);
                    float _e116 = (_e86.columns[0][1] * _e96.p[0][0]);
                    float _e117 = (_e86.columns[0][2] * _e96.p[0][0]);
                    float _e127 = (_e86.columns[1][0] * _e96.p[0][1]);
                    float _e128 = (_e86.columns[1][1] * _e96.p[0][1]);
                    float _e129 = (_e86.columns[1][2] * _e96.p[0][1]);
                    float _e139 = (_e86.columns[2][0] * _e96.p[0][2]);
                    float _e140 = (_e86.columns[2][1] * _e96.p[0][2]);
                    float _e141 = (_e86.columns[2][2] * _e96.p[0][2]);
                    float _e199 = (((((uintBitsToFloat((floatBitsToUint(_e115) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e115) + ((uintBitsToFloat((floatBitsToUint(_e127) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e127)) + ((uintBitsToFloat((floatBitsToUint(_e139) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e139)) + _e86.translation[0]);
                    float _e200 = (((((uintBitsToFloat((floatBitsToUint(_e116) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e116) + ((uintBitsToFloat((floatBitsToUint(_e128) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e128)) + ((uintBitsToFloat((floatBitsToUint(_e140) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e140)) + _e86.translation[1]);
                    float _e201 = (((((uintBitsToFloat((floatBitsToUint(_e117) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e117) + ((uintBitsToFloat((floatBitsToUint(_e129) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e129)) + ((uintBitsToFloat((floatBitsToUint(_e141) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e141)) + _e86.translation[2]);
                    float _e202 = -(1099511600000.0);
                    v0_2 = _e202;
                    if ((_e199 < _e202)) {
                    } else {
                        v0_2 = ((_e199 > 1099511600000.0) ? 1099511600000.0 : _e199);
                    }
                    float _e207 = v0_2;
                    v1_2 = _e202;
                    if ((_e200 < _e202)) {
                    } else {
                        v1_2 = ((_e200 > 1099511600000.0) ? 1099511600000.0 : _e200);
                    }
                    float _e217 = v1_2;
                    v2_2 = _e202;
                    if ((_e201 < _e202)) {
                    } else {
                        v2_2 = ((_e201 > 1099511600000.0) ? 1099511600000.0 : _e201);
                    }
                    float _e227 = v2_2;
                    float _e237 = (_e86.columns[0][0] * _e96.p[1][0]);
                    float _e238 = (_e86.columns[0][1] * _e96.p[1][0]);
                    float _e239 = (_e86.columns[0][2] * _e96.p[1][0]);
                    float _e240 = (_e86.columns[1][0] * _e96.p[1][1]);
                    float _e241 = (_e86.columns[1][1] * _e96.p[1][1]);
                    float _e242 = (_e86.columns[1][2] * _e96.p[1][1]);
                    float _e243 = (_e86.columns[2][0] * _e96.p[1][2]);
                    float _e244 = (_e86.columns[2][1] * _e96.p[1][2]);
                    float _e245 = (_e86.columns[2][2] * _e96.p[1][2]);
                    float _e297 = (((((uintBitsToFloat((floatBitsToUint(_e237) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e237) + ((uintBitsToFloat((floatBitsToUint(_e240) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e240)) + ((uintBitsToFloat((floatBitsToUint(_e243) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e243)) + _e86.translation[0]);
                    float _e298 = (((((uintBitsToFloat((floatBitsToUint(_e238) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e238) + ((uintBitsToFloat((floatBitsToUint(_e241) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e241)) + ((uintBitsToFloat((floatBitsToUint(_e244) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e244)) + _e86.translation[1]);
                    float _e299 = (((((uintBitsToFloat((floatBitsToUint(_e239) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e239) + ((uintBitsToFloat((floatBitsToUint(_e242) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e242)) + ((uintBitsToFloat((floatBitsToUint(_e245) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e245)) + _e86.translation[2]);
                    v3_2 = _e202;
                    if ((_e297 < _e202)) {
                    } else {
                        v3_2 = ((_e297 > 1099511600000.0) ? 1099511600000.0 : _e297);
                    }
                    float _e304 = v3_2;
                    v4_2 = _e202;
                    if ((_e298 < _e202)) {
                    } else {
                        v4_2 = ((_e298 > 1099511600000.0) ? 1099511600000.0 : _e298);
                    }
                    float _e314 = v4_2;
                    v5_2 = _e202;
                    if ((_e299 < _e202)) {
                    } else {
                        v5_2 = ((_e299 > 1099511600000.0) ? 1099511600000.0 : _e299);
                    }
                    float _e324 = v5_2;
                    float _e330[3] = float[3](((uintBitsToFloat((floatBitsToUint(_e304) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e304), ((uintBitsToFloat((floatBitsToUint(_e314) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e314), ((uintBitsToFloat((floatBitsToUint(_e324) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e324));
                    float _e334 = (_e86.columns[0][0] * _e96.p[2][0]);
                    float _e335 = (_e86.columns[0][1] * _e96.p[2][0]);
                    float _e336 = (_e86.columns[0][2] * _e96.p[2][0]);
                    float _e337 = (_e86.columns[1][0] * _e96.p[2][1]);
                    float _e338 = (_e86.columns[1][1] * _e96.p[2][1]);
                    float _e339 = (_e86.columns[1][2] * _e96.p[2][1]);
                    float _e340 = (_e86.columns[2][0] * _e96.p[2][2]);
                    float _e341 = (_e86.columns[2][1] * _e96.p[2][2]);
                    float _e342 = (_e86.columns[2][2] * _e96.p[2][2]);
                    float _e394 = (((((uintBitsToFloat((floatBitsToUint(_e334) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e334) + ((uintBitsToFloat((floatBitsToUint(_e337) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e337)) + ((uintBitsToFloat((floatBitsToUint(_e340) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e340)) + _e86.translation[0]);
                    float _e395 = (((((uintBitsToFloat((floatBitsToUint(_e335) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e335) + ((uintBitsToFloat((floatBitsToUint(_e338) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e338)) + ((uintBitsToFloat((floatBitsToUint(_e341) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e341)) + _e86.translation[1]);
                    float _e396 = (((((uintBitsToFloat((floatBitsToUint(_e336) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e336) + ((uintBitsToFloat((floatBitsToUint(_e339) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e339)) + ((uintBitsToFloat((floatBitsToUint(_e342) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e342)) + _e86.translation[2]);
                    v6_2 = _e202;
                    if ((_e394 < _e202)) {
                    } else {
                        v6_2 = ((_e394 > 1099511600000.0) ? 1099511600000.0 : _e394);
                    }
                    float _e401 = v6_2;
                    v7_2 = _e202;
                    if ((_e395 < _e202)) {
                    } else {
                        v7_2 = ((_e395 > 1099511600000.0) ? 1099511600000.0 : _e395);
                    }
                    float _e411 = v7_2;
                    v8_2 = _e202;
                    if ((_e396 < _e202)) {
                    } else {
                        v8_2 = ((_e396 > 1099511600000.0) ? 1099511600000.0 : _e396);
                    }
                    float _e421 = v8_2;
                    float _e427[3] = float[3](((uintBitsToFloat((floatBitsToUint(_e401) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e401), ((uintBitsToFloat((floatBitsToUint(_e411) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e411), ((uintBitsToFloat((floatBitsToUint(_e421) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e421));
                    bool _e430 = ((_e86.mirrored & 1u) != 0u);
                    v9_2 = _e330;
                    if (_e430) {
                        v9_2 = _e427;
                    }
                    float _e432[3] = v9_2;
                    v10_2 = _e427;
                    if (_e430) {
                        v10_2 = _e330;
                    }
                    float _e434[3] = v10_2;
                    float _e436 = (_e96.p[1][0] - _e96.p[0][0]);
                    float _e437 = (_e96.p[1][1] - _e96.p[0][1]);
                    float _e438 = (_e96.p[1][2] - _e96.p[0][2]);
                    float _e439 = (_e96.p[2][0] - _e96.p[0][0]);
                    float _e440 = (_e96.p[2][1] - _e96.p[0][1]);
                    float _e441 = (_e96.p[2][2] - _e96.p[0][2]);
                    float _e444 = uintBitsToFloat((floatBitsToUint(_e436) & 2147483647u));
                    float _e447 = uintBitsToFloat((floatBitsToUint(_e437) & 2147483647u));
                    float _e450 = uintBitsToFloat((floatBitsToUint(_e438) & 2147483647u));
                    float _e453 = uintBitsToFloat((floatBitsToUint(_e439) & 2147483647u));
                    float _e456 = uintBitsToFloat((floatBitsToUint(_e440) & 2147483647u));
                    float _e459 = uintBitsToFloat((floatBitsToUint(_e441) & 2147483647u));
                    float _e468 = uintBitsToFloat((floatBitsToUint(((_e444 > _e453) ? _e444 : _e453)) & 2147483647u));
                    float _e471 = uintBitsToFloat((floatBitsToUint(((_e447 > _e456) ? _e447 : _e456)) & 2147483647u));
                    float _e474 = uintBitsToFloat((floatBitsToUint(((_e450 > _e459) ? _e450 : _e459)) & 2147483647u));
                    float _e476 = ((_e468 > _e471) ? _e468 : _e471);
                    int _e484 = (int(((floatBitsToUint(((_e476 > _e474) ? _e476 : _e474)) >> uint(23)) & 255u)) - 127);
                    int _e486 = ((_e484 > -127) ? _e484 : -127);
                    int _e487 = -(_e486);
                    int _e489 = ((_e487 < -126) ? -126 : _e487);
                    float _e496 = uintBitsToFloat((uint((((_e489 > 127) ? 127 : _e489) + 127)) << uint(23)));
                    float _e497 = (_e436 * _e496);
                    float _e498 = (_e437 * _e496);
                    float _e499 = (_e438 * _e496);
                    float _e500 = (_e439 * _e496);
                    float _e501 = (_e440 * _e496);
                    float _e502 = (_e441 * _e496);
                    float _e514 = uintBitsToFloat((floatBitsToUint(((_e498 * _e502) - (_e499 * _e501))) & 2147483647u));
                    float _e517 = uintBitsToFloat((floatBitsToUint(((_e499 * _e500) - (_e497 * _e502))) & 2147483647u));
                    float _e520 = uintBitsToFloat((floatBitsToUint(((_e497 * _e501) - (_e498 * _e500))) & 2147483647u));
                    float _e522 = ((_e514 > _e517) ? _e514 : _e517);
                    int _e530 = (int(((floatBitsToUint(((_e522 > _e520) ? _e522 : _e520)) >> uint(23)) & 255u)) - 127);
                    bool _e548 = (((((_e530 > -127) ? _e530 : -127) >= -100) && (_e486 > -127)) && ((((0.2126 * _e96.radiance[0]) + (0.7152 * _e96.radiance[1])) + (0.0722 * _e96.radiance[2])) > 0.0));
                    float _e551 = (_e96.radiance[0] * _e86.radiance[0]);
                    v11_2 = 7.888609e-31;
                    if ((_e551 < 7.888609e-31)) {
                    } else {
                        v11_2 = ((_e551 > 1.2676506e30) ? 1.2676506e30 : _e551);
                    }
                    float _e556 = v11_2;
                    float _e564 = (_e96.radiance[1] * _e86.radiance[1]);
                    v12_2 = 7.888609e-31;
                    if ((_e564 < 7.888609e-31)) {
                    } else {
                        v12_2 = ((_e564 > 1.2676506e30) ? 1.2676506e30 : _e564);
                    }
                    float _e569 = v12_2;
                    float _e577 = (_e96.radiance[2] * _e86.radiance[2]);
                    v13_2 = 7.888609e-31;
                    if ((_e577 < 7.888609e-31)) {
                    } else {
                        v13_2 = ((_e577 > 1.2676506e30) ? 1.2676506e30 : _e577);
                    }
                    float _e582 = v13_2;
                    v14_2 = LightbvhLight(float[3][3](float[3](((uintBitsToFloat((floatBitsToUint(_e207) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e207), ((uintBitsToFloat((floatBitsToUint(_e217) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e217), ((uintBitsToFloat((floatBitsToUint(_e227) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e227)), _e432, _e434), float[3](((((_e96.radiance[0] > 0.0) && (_e86.radiance[0] > 0.0)) && _e548) ? _e556 : 0.0), ((((_e96.radiance[1] > 0.0) && (_e86.radiance[1] > 0.0)) && _e548) ? _e569 : 0.0), ((((_e96.radiance[2] > 0.0) && (_e86.radiance[2] > 0.0)) && _e548) ? _e582 : 0.0)), _e82, _e96.flags);
                }
                LightbvhLight _e592 = v14_2;
                v15_2 = _e592;
            }
            LightbvhLight _e594 = v15_2;
            v16_2 = _e594;
        }
        LightbvhLight _e596 = v16_2;
        float _e598[2] = numbers_1;
        float _e609 = (_e596.p[1][0] - _e596.p[0][0]);
        float _e610 = (_e596.p[1][1] - _e596.p[0][1]);
        float _e611 = (_e596.p[1][2] - _e596.p[0][2]);
        float _e617 = (_e596.p[2][0] - _e596.p[0][0]);
        float _e618 = (_e596.p[2][1] - _e596.p[0][1]);
        float _e619 = (_e596.p[2][2] - _e596.p[0][2]);
        float _e622 = uintBitsToFloat((floatBitsToUint(_e609) & 2147483647u));
        float _e625 = uintBitsToFloat((floatBitsToUint(_e610) & 2147483647u));
        float _e628 = uintBitsToFloat((floatBitsToUint(_e611) & 2147483647u));
        float _e631 = uintBitsToFloat((floatBitsToUint(_e617) & 2147483647u));
        float _e634 = uintBitsToFloat((floatBitsToUint(_e618) & 2147483647u));
        float _e637 = uintBitsToFloat((floatBitsToUint(_e619) & 2147483647u));
        float _e646 = uintBitsToFloat((floatBitsToUint(((_e622 > _e631) ? _e622 : _e631)) & 2147483647u));
        float _e649 = uintBitsToFloat((floatBitsToUint(((_e625 > _e634) ? _e625 : _e634)) & 2147483647u));
        float _e652 = uintBitsToFloat((floatBitsToUint(((_e628 > _e637) ? _e628 : _e637)) & 2147483647u));
        float _e654 = ((_e646 > _e649) ? _e646 : _e649);
        int _e662 = (int(((floatBitsToUint(((_e654 > _e652) ? _e654 : _e652)) >> uint(23)) & 255u)) - 127);
        int _e664 = ((_e662 > -127) ? _e662 : -127);
        int _e665 = -(_e664);
        int _e667 = ((_e665 < -126) ? -126 : _e665);
        float _e674 = uintBitsToFloat((uint((((_e667 > 127) ? 127 : _e667) + 127)) << uint(23)));
        float _e675 = (_e609 * _e674);
        float _e676 = (_e610 * _e674);
        float _e677 = (_e611 * _e674);
        float _e678 = (_e617 * _e674);
        float _e679 = (_e618 * _e674);
        float _e680 = (_e619 * _e674);
        float _e683 = ((_e676 * _e680) - (_e677 * _e679));
        float _e686 = ((_e677 * _e678) - (_e675 * _e680));
        float _e689 = ((_e675 * _e679) - (_e676 * _e678));
        float _e692 = uintBitsToFloat((floatBitsToUint(_e683) & 2147483647u));
        float _e695 = uintBitsToFloat((floatBitsToUint(_e686) & 2147483647u));
        float _e698 = uintBitsToFloat((floatBitsToUint(_e689) & 2147483647u));
        float _e700 = ((_e692 > _e695) ? _e692 : _e695);
        int _e708 = (int(((floatBitsToUint(((_e700 > _e698) ? _e700 : _e698)) >> uint(23)) & 255u)) - 127);
        int _e710 = ((_e708 > -127) ? _e708 : -127);
        bool _e711 = (_e710 >= -100);
        int _e714 = -(_e710);
        int _e716 = ((_e714 < -126) ? -126 : _e714);
        float _e723 = uintBitsToFloat((uint((((_e716 > 127) ? 127 : _e716) + 127)) << uint(23)));
        uint _e728 = (0u - ((_e711 && (_e664 > -127)) ? 1u : 0u));
        float _e731 = uintBitsToFloat((floatBitsToUint((_e683 * _e723)) & _e728));
        float _e734 = uintBitsToFloat((floatBitsToUint((_e686 * _e723)) & _e728));
        float _e739 = uintBitsToFloat((1065353216u ^ ((floatBitsToUint((_e689 * _e723)) ^ 1065353216u) & _e728)));
        uint _e745 = floatBitsToUint((((_e731 * _e731) + (_e734 * _e734)) + (_e739 * _e739)));
        uint _e748 = ((_e745 >> uint(23)) & 255u);
        uint _e750 = ((_e748 & 1u) ^ 1u);
        uint _e751 = (_e745 & 8388607u);
        float _e757 = uintBitsToFloat((_e751 | (1065353216u + (_e750 << uint(23)))));
        float _e763 = uintBitsToFloat((1597463007u - (floatBitsToUint(_e757) >> uint(1))));
        float _e764 = (0.5 * _e757);
        float _e768 = (_e763 * (1.5 - ((_e764 * _e763) * _e763)));
        float _e772 = (_e768 * (1.5 - ((_e764 * _e768) * _e768)));
        float _e776 = (_e772 * (1.5 - ((_e764 * _e772) * _e772)));
        float _e778 = ((_e757 * _e776) * 8388608.0);
        float _e779 = uintBitsToFloat(0u);
        float _e780 = uintBitsToFloat(1333788671u);
        uint _e785 = ((_e778 > _e780) ? 4294967295u : ((_e778 < _e779) ? 0u : uint(_e778)));
        uint _e788 = ((_e751 | 8388608u) << ((23u + _e750) & 31u));
        float _e796 = ((float((int((_e788 - (_e785 * _e785))) >> uint(8))) * _e776) * 1.5258789e-5);
        float _e797 = uintBitsToFloat(3472883712u);
        float _e798 = uintBitsToFloat(1325400063u);
        uint _e807 = (_e785 + uint(((_e796 == _e796) ? ((_e796 > _e798) ? 2147483647 : ((_e796 < _e797) ? -2147483648 : int(_e796))) : 0)));
        int _e810 = int((_e788 - (_e807 * _e807)));
        bool _e811 = (_e810 < 0);
        v17_2 = _e807;
        if (_e811) {
            v17_2 = (_e807 - 1u);
        }
        uint _e814 = v17_2;
        v18_2 = _e810;
        if (_e811) {
            v18_2 = (_e810 + ((2 * int(_e814)) + 1));
        }
        int _e820 = v18_2;
        int _e822 = (2 * int(_e814));
        bool _e823 = (_e820 > _e822);
        v19_2 = _e820;
        if (_e823) {
            v19_2 = (_e820 - (_e822 + 1));
        }
        int _e827 = v19_2;
        v20_2 = _e814;
        if (_e823) {
            v20_2 = (_e814 + 1u);
        }
        uint _e830 = v20_2;
        v21_2 = _e830;
        if ((_e827 > int(_e830))) {
            v21_2 = (_e830 + 1u);
        }
        uint _e835 = v21_2;
        v22_2 = 0.0;
        if ((int(_e745) < 8388608)) {
        } else {
            v22_2 = uintBitsToFloat((((((_e748 + 127u) - _e750) >> uint(1)) << uint(23)) + (_e835 - 8388608u)));
        }
        float _e848 = v22_2;
        uint _e849 = floatBitsToUint(_e848);
        uint _e855 = (_e849 & 8388607u);
        uint _e856 = (_e855 | 8388608u);
        bool _e857 = (8388608u < _e856);
        float _e861 = uintBitsToFloat((_e855 | 1065353216u));
        uint _e862 = floatBitsToUint(_e861);
        float _e867 = uintBitsToFloat(((_e862 & 2147483648u) | (2129859015u - (_e862 & 2147483647u))));
        float _e870 = (_e867 * (2.0 - (_e861 * _e867)));
        float _e873 = (_e870 * (2.0 - (_e861 * _e870)));
        float _e876 = ((uintBitsToFloat(1065353216u) * _e873) * (_e857 ? 16777216.0 : 8388608.0));
        uint _e881 = ((_e876 > _e780) ? 4294967295u : ((_e876 < _e779) ? 0u : uint(_e876)));
        int _e887 = int(((8388608u << uint(((_e857 ? 24 : 23) & 31))) - (_e881 * _e856)));
        float _e892 = ((float((_e887 >> uint(8))) * _e873) * 3.0517578e-5);
        int _e899 = ((_e892 == _e892) ? ((_e892 > _e798) ? 2147483647 : ((_e892 < _e797) ? -2147483648 : int(_e892))) : 0);
        uint _e901 = (_e881 + uint(_e899));
        int _e902 = int(_e856);
        int _e904 = (_e887 - (_e899 * _e902));
        bool _e905 = (_e904 < 0);
        v23_2 = _e901;
        if (_e905) {
            v23_2 = (_e901 - 1u);
        }
        uint _e908 = v23_2;
        v24_2 = _e904;
        if (_e905) {
            v24_2 = (_e904 + _e902);
        }
        int _e911 = v24_2;
        bool _e912 = (_e911 >= _e902);
        v25_2 = _e908;
        if (_e912) {
            v25_2 = (_e908 + 1u);
        }
        uint _e915 = v25_2;
        v26_2 = _e911;
        if (_e912) {
            v26_2 = (_e911 - _e902);
        }
        int _e918 = v26_2;
        v27_2 = _e915;
        if (((_e918 * 2) > _e902)) {
            v27_2 = (_e915 + 1u);
        }
        uint _e923 = v27_2;
        int _e927 = ((127 - int(((_e849 >> uint(23)) & 255u))) + (_e857 ? 126 : 127));
        bool _e928 = (_e927 <= 0);
        v29_2 = 0u;
        if (_e928) {
        } else {
            v28_2 = 2139095040u;
            if ((_e927 >= 255)) {
            } else {
                v28_2 = ((uint(_e927) << uint(23)) + (_e923 & 8388607u));
            }
            uint _e936 = v28_2;
            v29_2 = _e936;
        }
        uint _e938 = v29_2;
        float _e941 = uintBitsToFloat((((1065353216u ^ _e849) & 2147483648u) | (_e928 ? 0u : _e938)));
        int _e945 = -(((_e710 + _e664) + _e664));
        int _e947 = ((_e945 < -126) ? -126 : _e945);
        float _e955 = ((_e941 + _e941) * uintBitsToFloat((uint((((_e947 > 127) ? 127 : _e947) + 127)) << uint(23))));
        bool _e959 = ((_e598[0] + _e598[1]) > 1.0);
        v30_2 = _e598[0];
        if (_e959) {
            v30_2 = (1.0 - _e598[0]);
        }
        float _e962 = v30_2;
        v31_2 = _e598[1];
        if (_e959) {
            v31_2 = (1.0 - _e598[1]);
        }
        float _e965 = v31_2;
        float _e966 = (_e609 * _e962);
        float _e967 = (_e610 * _e962);
        float _e968 = (_e611 * _e962);
        float _e987 = (_e617 * _e965);
        float _e988 = (_e618 * _e965);
        float _e989 = (_e619 * _e965);
        v32_2 = float[3](0.0, 0.0, 0.0);
        if (_e711) {
            v32_2 = float[3]((_e731 * _e941), (_e734 * _e941), (_e739 * _e941));
        }
        float _e1019[3] = v32_2;
        results_2 = LightbvhType34_(float[3](((_e596.p[0][0] + ((uintBitsToFloat((floatBitsToUint(_e966) & 2147483647u)) < 9.8607613e-32) ? 0.0 : _e966)) + ((uintBitsToFloat((floatBitsToUint(_e987) & 2147483647u)) < 9.8607613e-32) ? 0.0 : _e987)), ((_e596.p[0][1] + ((uintBitsToFloat((floatBitsToUint(_e967) & 2147483647u)) < 9.8607613e-32) ? 0.0 : _e967)) + ((uintBitsToFloat((floatBitsToUint(_e988) & 2147483647u)) < 9.8607613e-32) ? 0.0 : _e988)), ((_e596.p[0][2] + ((uintBitsToFloat((floatBitsToUint(_e968) & 2147483647u)) < 9.8607613e-32) ? 0.0 : _e968)) + ((uintBitsToFloat((floatBitsToUint(_e989) & 2147483647u)) < 9.8607613e-32) ? 0.0 : _e989))), (_e711 ? ((_e955 < 1.329228e36) ? _e955 : 1.329228e36) : 0.0), _e1019, _e596.flags, _e596.radiance);
        break;
    } while(false);
    LightbvhType34_ _e1056 = results_2;
    return LightbvhLightPoint(vec3(_e1056.member[0], _e1056.member[1], _e1056.member[2]), _e1056.member_1, vec3(_e1056.member_2[0], _e1056.member_2[1], _e1056.member_2[2]), _e1056.member_3, vec3(_e1056.member_4[0], _e1056.member_4[1], _e1056.member_4[2]));
}
